"""What a batch costs: lines a second, CPU seconds a line, memory of a process, time to the first result.

    python benchmarks/batch.py                      # to curves, by one process and by two
    python benchmarks/batch.py --arkit              # to ARKit weights
    python benchmarks/batch.py --recordings         # from recordings with transcripts
    python benchmarks/batch.py --ray                # by a local cluster of Ray as well

Lines of about three seconds. The ways alternate in one run, since the machine's speed wanders; compare those.
"""

from __future__ import annotations

import argparse
import resource
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import risorius
from risorius.batches.outcome import LineResult

SUBJECTS = ("The harbour", "My sister", "The old captain", "Nobody here", "Your letter", "This road")
ENDS = ("is not what it was before the war", "went away on Monday night", "will come home with us tomorrow")


@dataclass(frozen=True)
class Reading:
    """What one run took: seconds in all and to the first line, CPU seconds and the largest process in bytes.

    `cpu` is for a line, without starts and the voice's process; `cpu_all` in all, 0 where it cannot be read.
    """

    way: str
    lines: int
    seconds: float
    first: float
    cpu: float
    cpu_all: float
    memory: int


def texts(count: int) -> Iterator[dict[str, object]]:
    """Yield lines of about three seconds, no two alike."""
    for n in range(count):
        text = f"{SUBJECTS[n % len(SUBJECTS)]} {ENDS[n % len(ENDS)]}, number {n}."
        yield {"id": f"{n:05d}", "text": text}


def recordings(rows: list[dict[str, object]], folder: Path) -> list[dict[str, object]]:
    """Return the lines as recordings with transcripts."""
    for _ in risorius.batch(rows, f"{folder}/voice/{{id}}.wav"):
        pass
    return [{"id": r["id"], "audio": f"{folder}/voice/{r['id']}.wav", "transcript": r["text"]} for r in rows]


def measure(way: str, rows: list[dict[str, object]], output: str, jobs: int, ray: str | None) -> Reading:
    before, start, first = _cpu(), time.perf_counter(), 0.0
    results: list[LineResult] = []
    for result in risorius.batch(rows, output, jobs=jobs, ray=ray):
        first = first or time.perf_counter() - start
        results.append(result)
    seconds = time.perf_counter() - start
    failed = [result.error for result in results if result.error]
    if failed:
        print(f"{len(failed)} failed, the first: {failed[0]}")
    results = [result for result in results if not result.error]
    cpu = sum(result.outcome.cpu for result in results) / len(results)
    cpu_all = 0.0 if ray else _cpu() - before  # processes of a cluster are not our children
    memory = max(result.outcome.memory for result in results)
    return Reading(way, len(results), seconds, first, cpu, cpu_all, memory)


def _cpu() -> float:
    """Return the CPU seconds of this process and its children that have ended."""
    usage = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(part.ru_utime + part.ru_stime for part in usage)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--lines", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--arkit", action="store_true")
    parser.add_argument("--recordings", action="store_true")
    parser.add_argument("--ray", action="store_true")
    options = parser.parse_args()
    suffix = ".arkit.csv" if options.arkit else ".muscles.csv"
    ways = [("1 process", 1, None), ("2 processes", 2, None)] + [("2 of Ray", 2, "local")] * options.ray
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = list(texts(options.lines))
        rows = recordings(rows, folder) if options.recordings else rows
        for way, jobs, ray in ways[:1]:  # kernels are compiled and files are in memory before anything counts
            measure(way, rows[:2], f"{folder}/warm/{{id}}{suffix}", jobs, ray)
        for turn in range(options.rounds):
            for number, (way, jobs, ray) in enumerate(ways):
                reading = measure(way, rows, f"{folder}/{turn}-{number}/{{id}}{suffix}", jobs, ray)
                print(_line(reading), flush=True)


def _line(reading: Reading) -> str:
    return (
        f"{reading.way:12} {reading.lines / reading.seconds:6.2f} lines/s,"
        f" {(reading.lines - 1) / (reading.seconds - reading.first):6.2f} once begun"
        f"  {reading.cpu:6.3f} CPU s a line, {reading.cpu_all:6.1f} in all"
        f"  first after {reading.first:5.2f} s  {reading.memory / 1e6:4.0f} MB"
    )


if __name__ == "__main__":
    main()
