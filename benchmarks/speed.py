"""All speeds in one table: before and after, beside what is asked and where the limits are.

    python benchmarks/speed.py                        # this checkout alone
    python benchmarks/speed.py --before 7322b18       # and another commit, in turn with it
    python benchmarks/speed.py --before main planning face --runs 5

Every run is a process of its own. With `--before` the commit is checked out in a temporary folder, and the
two take turns, so that a machine that is slow for a while is slow for both; the best of all runs counts, and
the first may compile kernels. The command ends with 1 if a row has fallen by more than `--fall`, a fifth by
default. Rows in seconds are those of processors, this process' and its children's; rows of times real time
and of frames are by the clock. Programs may import those of this folder, which are this checkout's for both.
A row that the other commit cannot run has no figure before.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
ROWS = Path(__file__).with_name("speed.toml")


@dataclass(frozen=True)
class Row:
    """What is measured, from `speed.toml`.

    `program` prints a number, unless `seconds` is true: then its processor time counts. `asked` is the least
    that is asked for; of seconds, and where `low` is true, the most; None where nothing is. `fresh`: with an
    empty cache. `runs`: how often it runs, fewer where a run takes long and they differ little.
    """

    name: str
    what: str
    program: str
    asked: float | None = None
    beside: str = ""
    seconds: bool = False
    low: bool = False
    fresh: bool = False
    runs: int = 3

    @property
    def wanted_low(self) -> bool:
        """Whether less is better."""
        return self.seconds or self.low

    def better(self, values: Sequence[float]) -> float:
        """Return the best of some values."""
        return min(values) if self.wanted_low else max(values)

    def misses(self, value: float) -> bool:
        """Whether a value is not what is asked for."""
        return self.asked is not None and self.better([value, self.asked]) != value

    def gain(self, before: float, after: float) -> float:
        """Return how many times as fast `after` is."""
        return before / after if self.wanted_low else after / before


def rows() -> dict[str, Row]:
    """Return the table's rows by name."""
    table = tomllib.loads(ROWS.read_text(encoding="utf-8"))
    return {name: Row(name, **entry) for name, entry in table.items()}


class FailedError(Exception):
    """A program failed; the message says what it complained of."""


def measured(row: Row, tree: Path) -> float:
    """Return one run's number with the package of a tree; raise FailedError."""
    with tempfile.TemporaryDirectory() as folder:
        paths = os.pathsep.join([str(tree / "src"), str(ROOT / "benchmarks")])
        variables = {**os.environ, "PYTHONPATH": paths, "OPENBLAS_NUM_THREADS": "1"}
        if row.fresh:
            # The second is what older trees read.
            for name in ("RISORIUS_CACHE_DIR", "NUMBA_CACHE_DIR"):
                variables[name] = str(Path(folder) / "cache")
        command = [sys.executable, "-c", row.program]
        complaints = Path(folder) / "complaints"
        with complaints.open("w") as errors:
            process = subprocess.Popen(
                command, cwd=folder, env=variables, stdout=subprocess.PIPE, stderr=errors, text=True
            )
        assert process.stdout is not None
        said = process.stdout.read()
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise FailedError(f"{row.name} failed in {tree}:\n{complaints.read_text()}")
    return used.ru_utime + used.ru_stime if row.seconds else float(said.split()[-1])


@contextmanager
def checked_out(commit: str | None) -> Iterator[list[Path]]:
    """Yield the trees to measure: that of a commit, if any, then this one."""
    if commit is None:
        yield [ROOT]
        return
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder) / "before"
        git = ["git", "-C", str(ROOT), "worktree"]
        subprocess.run([*git, "add", "--quiet", "--detach", str(tree), commit], check=True)
        try:
            yield [tree, ROOT]
        finally:
            subprocess.run([*git, "remove", "--force", str(tree)], check=True)


def main() -> int:
    """Measure and print the table; return 1 if a row has fallen."""
    table = rows()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("rows", nargs="*", choices=[[], *table], metavar="ROW", help=", ".join(table))
    parser.add_argument("--before", metavar="COMMIT", help="another commit to measure in turn with this one")
    parser.add_argument("--runs", type=int, help="instead of each row's own; at least 2")
    parser.add_argument("--fall", type=float, default=0.2, help="the share by which a row may fall")
    asked = parser.parse_args()
    if asked.runs is not None and asked.runs < 2:
        parser.error(f"--runs {asked.runs}; expected 2 or more, since the first run may compile kernels")
    chosen = [table[name] for name in asked.rows] or list(table.values())
    written = "not written" if sys.dont_write_bytecode else "written"
    print(f"Bytecode is {written}; Python {sys.version.split()[0]}, {os.cpu_count()} processors\n")
    print("| what | before | now | gain | asked | beside |\n|---|---|---|---|---|---|")
    fallen, missed, begun = [], [], time.monotonic()
    with checked_out(asked.before) as trees:
        for row in chosen:
            before, now = _in_turn(row, trees, asked.runs or row.runs)
            gain = None if before is None else row.gain(before, now)
            if gain is not None and gain < 1.0 - asked.fall:
                fallen.append(row.name)
            if row.misses(now):
                missed.append(row.name)
            sign = "≤" if row.wanted_low else "≥"
            limit = "" if row.asked is None else f"{sign} {row.asked:g}"
            cells = row.what, _number(before), _number(now), _number(gain), limit, row.beside
            print(f"| {' | '.join(cells)} |", flush=True)
    print(f"\nMeasured in {(time.monotonic() - begun) / 60.0:.1f} minutes")
    if missed:
        print(f"\nNot yet as asked: {', '.join(missed)}")
    if fallen:
        print(f"\nFallen by more than {asked.fall:.0%}: {', '.join(fallen)}")
    return int(bool(fallen))


def _in_turn(row: Row, trees: Sequence[Path], runs: int) -> tuple[float | None, float]:
    """Return the best run of the other tree, None if there is none or it fails, and that of this one."""
    found: dict[Path, list[float]] = {tree: [] for tree in trees}
    for _ in range(runs):
        for tree in list(found):
            try:
                found[tree].append(measured(row, tree))
            except FailedError as error:
                if tree == ROOT:
                    raise SystemExit(str(error)) from None
                print(error, file=sys.stderr)
                del found[tree]
    best = {tree: row.better(values) for tree, values in found.items()}
    return best.get(trees[0]) if len(trees) > 1 else None, best[ROOT]


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.0f}" if value >= 100 else f"{value:.2f}"


if __name__ == "__main__":
    sys.exit(main())
