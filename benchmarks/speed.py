"""All speeds in one table: before and after, beside what is asked and where the limits are.

    python benchmarks/speed.py                        # this checkout alone
    python benchmarks/speed.py --before 7322b18       # and another commit, in turn with it
    python benchmarks/speed.py --before main planning face --runs 5

Every run is a process of its own. With `--before` the commit is checked out in a temporary folder, and the
two take turns, so that a machine that is slow for a while is slow for both; the best of all runs counts. The
command ends with 1 if a row has fallen by more than `--fall`, a fifth by default. Rows in seconds are those
of processors, this process' and its children's; rows of times real time and of frames are by the clock.

The first run of each tree compiles its kernels and does not count, except in the row `first_picture`, which
has an empty cache each time (half a minute) and is measured when it is named.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
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
    that is asked for; of seconds, and where `low` is true, the most. `fresh`: with an empty cache.
    """

    name: str
    what: str
    program: str
    asked: float
    beside: str = ""
    seconds: bool = False
    low: bool = False
    fresh: bool = False

    @property
    def wanted_low(self) -> bool:
        """Whether less is better."""
        return self.seconds or self.low

    def better(self, values: Sequence[float]) -> float:
        """Return the best of some values."""
        return min(values) if self.wanted_low else max(values)

    def gain(self, before: float, after: float) -> float:
        """Return how many times as fast `after` is."""
        return before / after if self.wanted_low else after / before


def rows() -> dict[str, Row]:
    """Return the table's rows by name."""
    table = tomllib.loads(ROWS.read_text(encoding="utf-8"))
    return {name: Row(name, **entry) for name, entry in table.items()}


def measured(row: Row, tree: Path) -> float:
    """Return one run's number with the package of a tree."""
    with tempfile.TemporaryDirectory() as folder:
        variables = {**os.environ, "PYTHONPATH": str(tree / "src"), "OPENBLAS_NUM_THREADS": "1"}
        if row.fresh:
            variables["NUMBA_CACHE_DIR"] = str(Path(folder) / "cache")
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
            raise SystemExit(f"{row.name} failed in {tree}:\n{complaints.read_text()}")
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
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--fall", type=float, default=0.2, help="the share by which a row may fall")
    asked = parser.parse_args()
    chosen = [table[name] for name in asked.rows] or [row for row in table.values() if not row.fresh]
    written = "not written" if sys.dont_write_bytecode else "written"
    print(f"Bytecode is {written}; Python {sys.version.split()[0]}, {os.cpu_count()} processors\n")
    print("| what | before | now | gain | asked | beside |\n|---|---|---|---|---|---|")
    fallen, missed = [], []
    with checked_out(asked.before) as trees:
        for row in chosen:
            values = _in_turn(row, trees, asked.runs)
            now, before = values[-1], values[0] if len(values) > 1 else None
            gain = 1.0 if before is None else row.gain(before, now)
            if gain < 1.0 - asked.fall:
                fallen.append(row.name)
            if row.better([now, row.asked]) != now:
                missed.append(row.name)
            sign, compared = "≤" if row.wanted_low else "≥", "" if before is None else f"{gain:.2f}"
            cells = row.what, _number(before), _number(now), compared, f"{sign} {row.asked:g}", row.beside
            print(f"| {' | '.join(cells)} |", flush=True)
    if missed:
        print(f"\nNot yet as asked: {', '.join(missed)}")
    if fallen:
        print(f"\nFallen by more than {asked.fall:.0%}: {', '.join(fallen)}")
    return int(bool(fallen))


def _in_turn(row: Row, trees: Sequence[Path], runs: int) -> list[float]:
    """Return the best of each tree's runs."""
    found: list[list[float]] = [[] for _ in trees]
    for number in range(runs if row.fresh else runs + 1):
        for values, tree in zip(found, trees, strict=True):
            value = measured(row, tree)
            if number or row.fresh:
                values.append(value)
    return [row.better(values) for values in found]


def _number(value: float | None) -> str:
    return "" if value is None else f"{value:.0f}" if value >= 100 else f"{value:.2f}"


if __name__ == "__main__":
    sys.exit(main())
