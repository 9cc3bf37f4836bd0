"""A clock for tests: no time passes but what is slept."""

from __future__ import annotations

from risorius.live.stream.clock import MachineClock


class SleepingClock(MachineClock):
    """Starts at 0 and goes on by what it is asked to sleep, at once."""

    def __init__(self) -> None:
        super().__init__()
        self.seconds = 0.0

    def now(self) -> float:
        return self.seconds

    def sleep(self, seconds: float) -> None:
        self.seconds += max(seconds, 1e-6)  # at least a little: what is due must come
