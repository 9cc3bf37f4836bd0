"""Progress of a batch: a bar or occasional lines, and each failure up to a limit."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.units import clock
from .console import INTERVAL, Console
from .messages import is_watched

if TYPE_CHECKING:
    from ..batches.outcome import LineResult

MOST_ERRORS = 20  # failures that are printed


class BatchProgress:
    """Counts lines and says how it goes: rate and time left are those of the lines that had to be made."""

    def __init__(self, console: Console, total: int) -> None:
        self._console, self._total = console, total
        self.made = self.whole = self.failed = 0
        self._start = self._said = time.monotonic()

    def add(self, result: LineResult) -> None:
        """Take in the result of a line."""
        match result.state.value:
            case "made":
                self.made += 1
            case "whole":
                self.whole += 1
            case _:
                self.failed += 1
                self._say_failure(result.error)
        self._say_how_it_goes()

    def finish(self, folder: Path) -> None:
        """Report the outcome of the batch."""
        seconds = time.monotonic() - self._start
        lines = "1 line" if self.made == 1 else f"{self.made:,} lines"
        parts = [f"{lines} made in {clock(seconds)}"]
        if self.made:
            parts[0] += f" ({self._rate():.1f} a second)"
        if self.whole:
            parts.append(f"{self.whole:,} were already complete")
        if self.failed:
            parts.append(f"{self.failed:,} failed")
        self._console.say(f"{', '.join(parts)}; see {folder / 'report.html'}")

    def _say_failure(self, error: str) -> None:
        if self.failed <= MOST_ERRORS:
            self._console.fail(error)
        elif self.failed == MOST_ERRORS + 1:
            self._console.fail("more lines failed; errors.jsonl has them all")

    def _say_how_it_goes(self) -> None:
        done, now = self.made + self.whole + self.failed, time.monotonic()
        total = max(self._total, done)
        if is_watched():
            self._console.progress("Lines", done, total, f"{self._rate():.1f}/s")
        elif now - self._said >= INTERVAL:
            self._said = now
            left = (total - done) / self._rate() if self.made else 0.0
            self._console.say(f"{done:,} of {total:,} lines, {self._rate():.1f} a second, {clock(left)} left")

    def _rate(self) -> float:
        return self.made / max(time.monotonic() - self._start, 1e-3)
