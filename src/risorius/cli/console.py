"""Messages of the command line while it works: lines and a progress bar, on standard error."""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Iterable
from pathlib import Path
from types import FrameType, TracebackType
from typing import TYPE_CHECKING

from ..errors import warnings_to
from .messages import MessageForm, is_watched, message_form, send

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID


EXIT_INTERRUPTED = 130
_REMEMBERED = 16  # warnings that are not printed again
INTERVAL = 10.0  # seconds between lines if no bar is shown
_interrupted = threading.Event()


class Interrupted(KeyboardInterrupt):
    """The program is asked to end.

    Of a plain KeyboardInterrupt that passes through `exec`, Python remembers that nobody handled it, and ends
    by a signal in place of our exit code.
    """


def interrupt(number: int, frame: FrameType | None) -> None:
    """Handle a signal: stop here, or at the next step if the exception is lost in foreign code."""
    _interrupted.set()
    raise Interrupted


class Console:
    """Reports progress: by a bar if a person watches, by lines or JSON (`messages`) otherwise."""

    def __init__(self) -> None:
        self._bar: Progress | None = None
        self._tasks: dict[str, TaskID] = {}
        self._said: dict[str, float] = {}
        self._warnings = warnings_to(self._warn)
        self._told: deque[str] = deque(maxlen=_REMEMBERED)

    def say(self, line: str) -> None:
        """Report one line of progress, unless only faults are wanted."""
        if message_form() is not MessageForm.QUIET:
            self._send(line, message=line)

    def fail(self, line: str) -> None:
        """Report a fault after which the work goes on."""
        self._send(f"risorius: {line}", error=line)

    def wrote(self, outputs: Iterable[Path]) -> None:
        """Say which files were written."""
        names = [str(output) for output in outputs]
        if message_form() is not MessageForm.QUIET:
            self._send(f"Wrote {', '.join(names)}", wrote=names)

    def _warn(self, line: str) -> None:
        if line not in self._told:  # a line that is spoken twice warns twice
            self._told.append(line)
            self._send(f"risorius: warning: {line}", warning=line)

    def _send(self, line: str, /, **parts: object) -> None:
        if self._bar is not None:
            self._bar.console.print(line, highlight=False, markup=False)
        else:
            send(line, **parts)

    def progress(self, stage: str, done: int = 0, total: int = 0, note: str = "") -> None:
        """Say that `stage` goes on: `done` of `total` steps, or that it began if total is 0.

        `note` stands behind the bar. Without a bar a line comes every `INTERVAL` seconds, and at the end.
        """
        if _interrupted.is_set():
            raise Interrupted
        if message_form() is MessageForm.QUIET:
            return
        if total == 0:
            self._send(stage, stage=stage)
        elif is_watched():
            self._show(stage, done, total, note)
        elif done == total:
            self._send(f"{stage}: {total}", stage=stage, done=done, total=total)
        elif self._is_due(stage):
            self._send(f"{stage}: {done} of {total}", stage=stage, done=done, total=total)

    def _is_due(self, stage: str) -> bool:
        now = time.monotonic()
        due = now - self._said.setdefault(stage, now) >= INTERVAL
        if due:
            self._said[stage] = now
        return due

    def _show(self, stage: str, done: int, total: int, note: str) -> None:
        if self._bar is None:
            self._bar = _bar()
            self._bar.start()
        if stage not in self._tasks:
            self._tasks[stage] = self._bar.add_task(stage, total=total, note=note)
        self._bar.update(self._tasks[stage], completed=done, note=note)

    def __enter__(self) -> Console:
        self._warnings.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._warnings.__exit__(kind, error, trace)
        if self._bar is not None:
            self._bar.stop()


def _bar() -> Progress:
    from rich.console import Console as Terminal
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    return Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        TextColumn("{task.fields[note]}"),
        console=Terminal(stderr=True),
    )
