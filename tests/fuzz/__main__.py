"""Many spoilt files of every kind, without hypothesis, which would take most of the time.

    python -m tests.fuzz --cases 20000             # of each kind
    python -m tests.fuzz --seconds 3600 .json .utt # as many as fit into an hour, of two kinds

Prints a line for each kind: cases, failures, CPU time of the slowest case. What fails is written to a file
whose name is printed, and the command exits with 1. Random numbers are counted from `--seed`, so that a
failure can be had again.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from .cases import spoilt
from .guard import one_line_or_done
from .kinds import READERS

_SHOWN = 5  # failures of a kind that are kept


def main() -> int:
    """Read spoilt files until all are read or the time is over; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kinds", nargs="*", choices=[[], *READERS], metavar="KIND")
    parser.add_argument("--cases", type=int, default=20_000, help="of each kind")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="at most, for all kinds together")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    kinds = options.kinds or list(READERS)
    each = options.seconds / len(kinds)
    total = failed = 0
    with tempfile.TemporaryDirectory() as folder, _quiet_libraries():
        for kind in kinds:
            done, failures, slowest = _read_many(kind, options, each, Path(folder))
            total, failed = total + done, failed + failures
            print(f"{kind:16} {done:7} cases, {failures} failures, slowest {slowest:.2f} s", flush=True)
    print(f"{total} cases of {len(kinds)} kinds, {failed} failures")
    return int(failed > 0)


def _read_many(
    kind: str, options: argparse.Namespace, seconds: float, folder: Path
) -> tuple[int, int, float]:
    """Return how many cases of a kind were read, how many failed, and the CPU time of the slowest."""
    reader, end = READERS[kind], time.monotonic() + seconds
    path = folder / f"spoilt{kind}"
    done = failures = 0
    slowest = 0.0
    while done < options.cases and time.monotonic() < end:
        data = spoilt(kind, done, options.seed)
        path.write_bytes(data)
        start = time.process_time()
        try:
            with one_line_or_done():
                reader.read(path)
        except (pytest.fail.Exception, AssertionError) as error:
            failures += 1
            if failures <= _SHOWN:
                kept = Path(tempfile.gettempdir()) / f"risorius-fuzz-{options.seed}-{done}{kind}"
                kept.write_bytes(data)
                print(f"{kept}: {str(error)[:200]}", flush=True)
        slowest = max(slowest, time.process_time() - start)
        done += 1
    return done, failures, slowest


@contextmanager
def _quiet_libraries() -> Iterator[None]:
    """Send what libraries in C write to the standard error to nowhere."""
    sys.stderr.flush()
    kept, nowhere = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(nowhere)
        os.close(kept)


if __name__ == "__main__":
    sys.exit(main())
