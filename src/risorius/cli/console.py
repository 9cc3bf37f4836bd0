"""What the command line says while it works: lines and a progress bar, on standard error."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterable, Iterator, Sequence
from types import FrameType, TracebackType
from typing import TYPE_CHECKING

import click

from ..errors import warnings_to

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID


EXIT_INTERRUPTED = 130
_interrupted = threading.Event()


class Interrupted(KeyboardInterrupt):
    """The program is asked to end.

    Of a plain KeyboardInterrupt that passes through `exec`, Python remembers that nobody handled it, and ends
    by a signal in place of our exit code.
    """


def interrupt(number: int, frame: FrameType | None) -> None:
    """Handle a signal: stop here, or at the next step where the exception is lost in foreign code."""
    _interrupted.set()
    raise Interrupted


def say(line: str) -> None:
    """Print one line on standard error."""
    click.echo(line, err=True)


class Console:
    """Says what is being done. A bar where a person watches, plain lines otherwise."""

    def __init__(self) -> None:
        self._bar: Progress | None = None
        self._tasks: dict[str, TaskID] = {}
        self._warnings = warnings_to(lambda line: self.say(f"risorius: warning: {line}"))

    def say(self, line: str) -> None:
        """Print one line."""
        if self._bar is not None:
            self._bar.console.print(line, highlight=False, markup=False)
        else:
            print(line, file=sys.stderr, flush=True)

    def progress(self, stage: str, done: int = 0, total: int = 0, note: str = "") -> None:
        """Say that `stage` goes on: `done` of `total` steps, or that it began where total is 0.

        `note` stands behind the bar.
        """
        if _interrupted.is_set():
            raise Interrupted
        if total == 0:
            self.say(stage)
        elif sys.stderr.isatty():
            self._show(stage, done, total, note)
        elif done == total:
            self.say(f"{stage}: {total} frames")

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


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    """Yield the lines of a plain table: columns as wide as their widest cell, two spaces apart."""
    cells = [list(header), *(list(row) for row in rows)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
    for row in cells:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
