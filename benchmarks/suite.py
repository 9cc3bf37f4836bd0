"""What the tests cost, in seconds of the processor: `python benchmarks/suite.py [--most 30] [PYTEST'S …]`.

The time of threads and of all processes that a test starts counts; waiting does not, so that a busy machine
gives nearly the same numbers. Run it in one process (no `-n`), and twice: the first run compiles kernels.
Target: 400 s for all, those of the studio's page too, so that two processes need less than four minutes.
"""

from __future__ import annotations

import argparse
import os
import resource
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

_TICKS = os.sysconf("SC_CLK_TCK")


def processor_time() -> float:
    """Return the seconds that this process and all that it has started have used, on all processors."""
    ended = resource.getrusage(resource.RUSAGE_CHILDREN)
    alive = sum(_used(process) for process in set(_started_by(os.getpid())))
    return time.process_time() + ended.ru_utime + ended.ru_stime + alive


def _started_by(process: int) -> Iterator[int]:
    try:
        for thread in Path(f"/proc/{process}/task").iterdir():
            for child in map(int, (thread / "children").read_text().split()):
                yield child
                yield from _started_by(child)
    except OSError:  # it has just ended
        return


def _used(process: int) -> float:
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0.0
    return sum(map(int, fields[11:15])) / _TICKS


class Cost:
    """Collects what files cost to be imported, and tests with their fixtures, by pytest's node id."""

    def __init__(self) -> None:
        self.importing, self.running = Counter[str](), Counter[str]()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_make_collect_report(self, collector: pytest.Collector) -> Iterator[None]:
        start = processor_time()
        result = yield
        if isinstance(collector, pytest.Module):
            self.importing[collector.nodeid] += processor_time() - start
        return result

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        start = processor_time()
        result = yield
        self.running[item.nodeid] += processor_time() - start
        return result


def folder(nodeid: str) -> str:
    """Return the folder directly in `tests` that a test stands in, or its file."""
    parts = nodeid.partition("::")[0].split("/")
    return "/".join(parts[:2]) if len(parts) > 2 else "tests/*.py"


def summed(costs: Counter[str], name: Callable[[str], str]) -> Counter[str]:
    """Return costs added by what the function `name` makes of the node ids."""
    found = Counter[str]()
    for nodeid, seconds in costs.items():
        found[name(nodeid)] += seconds
    return found


def show(title: str, costs: Counter[str], most: int | None = None) -> None:
    """Print the largest costs."""
    print(f"\n{title}: {sum(costs.values()):.0f} s")
    for name, seconds in costs.most_common(most):
        print(f"{seconds:8.1f}  {name}")


def main() -> None:
    """Run pytest and print what it cost."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--most", type=int, default=30, help="how many tests are listed")
    options, arguments = parser.parse_known_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"  # as scripts/test
    cost = Cost()
    failed = pytest.main(["-q", *arguments], plugins=[cost])
    show("importing", cost.importing, 5)
    show("tests by folder", summed(cost.running, folder))
    show("tests", summed(cost.running, lambda nodeid: nodeid.partition("[")[0]), options.most)
    print(f"\nall, with pytest's own start: {processor_time():.0f} s")
    sys.exit(failed)


if __name__ == "__main__":
    main()
