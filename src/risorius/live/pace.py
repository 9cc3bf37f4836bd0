"""The times at which frames are due: the first at once, the others by the frame rate after it."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

Now = Callable[[], float]


class Pace:
    """Says how long to wait for a frame; `now` is a clock in seconds that never goes back."""

    def __init__(self, fps: Fraction, now: Now) -> None:
        self._fps = fps
        self._now = now
        self._origin: float | None = None

    def wait(self, index: int) -> float:
        """Return the seconds until a frame is due, 0 if its time has passed.

        Frames carry the sound, so that none is dropped: a late face catches up.
        """
        return max(0.0, -self._since(index))

    def late(self, index: int) -> float:
        """Return the seconds since a frame was due, 0 if its time has not come."""
        return max(0.0, self._since(index))

    def _since(self, index: int) -> float:
        now, due = self._now(), float(index / self._fps)
        if self._origin is None:
            self._origin = now - due
        return now - self._origin - due
