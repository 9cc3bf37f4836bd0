"""Synchrony: movements begin, arrive, leave and end where phonemes do (paper B, sections 3.1 and 5.2)."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated

from ..core.units import Share
from ..reading.hints import Range
from .load import load

Exponent = Annotated[float, Range(0.0, 2.0)]
SpeechRate = Annotated[float, Range(0.5, 20.0)]


@dataclass(frozen=True, slots=True)
class RateLaw:
    """The factor (usual / rate) ^ exponent within limits."""

    exponent: Exponent
    limits: tuple[float, float]

    def factor(self, rate: float, usual: float) -> float:
        """Return the factor at a rate where another is usual, both in syllables a second."""
        low, high = self.limits
        factor: float = (usual / max(rate, 0.1)) ** self.exponent
        return min(max(factor, low), high)


@dataclass(frozen=True, slots=True)
class Synchrony:
    """The table `synchrony.toml`. Syllables a second, seconds."""

    usual_rate: SpeechRate
    slow_rate: SpeechRate
    group_pause: Annotated[float, Range(0.0, 60.0)]
    reach: Share
    settling: Annotated[float, Range(0.0, 2.0)]
    least_time: Annotated[float, Range(0.1, 1.0)]
    duration: RateLaw
    size: RateLaw

    def duration_at(self, rate: float) -> float:
        """Return the factor on durations at a rate."""
        return self.duration.factor(rate, self.usual_rate)

    def size_at(self, rate: float) -> float:
        """Return the factor on sizes at a rate."""
        return self.size.factor(rate, self.usual_rate)


@cache
def synchrony() -> Synchrony:
    """Return the package's table."""
    return load(Synchrony, "synchrony.toml")


@dataclass(frozen=True, slots=True)
class MovementPhases:
    """The times at which a movement starts, is there, begins to leave and has ended, in seconds."""

    start: float
    apex: float
    release: float
    end: float


def ended_in_pause(span: MovementPhases, pauses: Sequence[float]) -> MovementPhases:
    """Return a span that has ended soon after the first pause that it runs into.

    `pauses` are the starts of those in which the head stands still, in order.
    """
    index = bisect_left(pauses, span.start)
    if index == len(pauses):
        return span
    table, length = synchrony(), span.end - span.start
    share = max((pauses[index] + table.settling - span.start) / length, table.least_time)
    if share >= 1.0:
        return span
    apex, release, end = (span.start + share * (t - span.start) for t in (span.apex, span.release, span.end))
    return MovementPhases(span.start, apex, release, end)


def snapped(span: MovementPhases, boundaries: Sequence[float]) -> MovementPhases:
    """Return a span with each time moved to the closest phoneme boundary within reach.

    The apex is where the time from the new start is closest to the onset, and likewise the end. Onset and
    offset keep a length: if one would vanish, its time stays unsnapped.
    """
    start = nearest(span.start, boundaries)
    onset, offset = span.apex - span.start, span.end - span.release
    apex = _after(start, start + onset, boundaries) if onset > 0.0 else start
    release = max(nearest(max(span.release, apex), boundaries), apex)
    end = _after(release, release + offset, boundaries) if offset > 0.0 else release
    return MovementPhases(start, apex, release, end)


def nearest(time: float, boundaries: Sequence[float], reach: float | None = None) -> float:
    """Return the boundary closest to a time, the time itself if none is within reach."""
    reach = synchrony().reach if reach is None else reach
    index = bisect_left(boundaries, time)
    before = boundaries[index - 1] if index else -math.inf
    after = boundaries[index] if index < len(boundaries) else math.inf
    best = before if time - before <= after - time else after
    return best if abs(best - time) <= reach else time


def _after(earlier: float, wanted: float, boundaries: Sequence[float]) -> float:
    found = nearest(wanted, boundaries)
    return found if found > earlier else wanted
