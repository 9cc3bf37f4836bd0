"""A token bucket: it limits how much may come in a time."""

from __future__ import annotations

from collections.abc import Callable


class TokenBucket:
    """Lets `most` through at once, and `rate` a second in the long run, by the clock `now` in seconds."""

    def __init__(self, rate: float, most: float, now: Callable[[], float]) -> None:
        self._rate, self._most, self._now = rate, most, now
        self._level, self._since = most, now()

    def take(self, amount: float = 1.0) -> bool:
        """Return whether this amount may come now; a refused amount takes no tokens."""
        now = self._now()
        self._level = min(self._most, self._level + self._rate * (now - self._since))
        self._since = now
        if amount > self._level:
            return False
        self._level -= amount
        return True
