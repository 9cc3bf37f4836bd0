"""What holds for every input: a result or one printable line, within bounds of time and memory."""

from __future__ import annotations

import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

import pytest

from risorius.errors import LONGEST_MESSAGE, RisoriusError, warnings_to

CPU_SECONDS = 2.0
"""Ten times what the slowest small and right input takes: a bound against hangs, not a measure of speed."""
MEMORY = 1_000_000_000  # bytes beyond what the process has


class HangError(BaseException):
    """A case took longer than it may; no reader can catch it by mistake."""


@contextmanager
def bounded(seconds: float = CPU_SECONDS, memory: int = MEMORY) -> Iterator[None]:
    """Raise HangError if the block takes more CPU time, and MemoryError if it takes more memory."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise HangError(f"took more than {seconds:g} s")

    before = signal.signal(signal.SIGVTALRM, stop)
    limits = resource.getrlimit(resource.RLIMIT_AS)
    try:
        resource.setrlimit(resource.RLIMIT_AS, (_size() + memory, limits[1]))
        signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)
        resource.setrlimit(resource.RLIMIT_AS, limits)


def _size() -> int:
    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()


@contextmanager
def one_line_or_done(seconds: float = CPU_SECONDS) -> Iterator[None]:
    """Let the block end well or with a RisoriusError that keeps its promises; anything else is a failure."""
    lines: list[str] = []
    with bounded(seconds), warnings_to(lines.append):
        try:
            yield
        except RisoriusError as error:
            lines.append(str(error))
        except (HangError, Exception) as error:
            pytest.fail(f"{type(error).__name__}: {str(error)[:300]}")
    for line in lines:
        assert line.isprintable()
        assert len(line) <= LONGEST_MESSAGE
