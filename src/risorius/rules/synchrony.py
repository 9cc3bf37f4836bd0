"""Synchrony: movements begin, arrive, leave and end where phonemes do (paper B, sections 3.1 and 5.2)."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Annotated

from ..core.units import Share
from ..reading.hints import Range
from .load import load

RISE = 0.4
"""The share of its shortest time in which a movement rises."""
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


def snapped(
    span: MovementPhases, boundaries: Sequence[float], limits: Sequence[float] = ()
) -> MovementPhases:
    """Return a span with each time moved to the closest phoneme boundary within reach.

    The apex is where the time from the new start is closest to the onset, and likewise the end. Onset and
    offset keep a length: if one would vanish, its time stays unsnapped. Neither ends later than at the first
    of `limits`, boundaries in order, that comes after it begins.
    """
    start = nearest(span.start, boundaries)
    onset, offset = span.apex - span.start, span.end - span.release
    until = _first_after(start, limits)
    apex = min(_after(start, start + onset, boundaries), until) if onset > 0.0 else start
    release = max(nearest(max(span.release, apex), boundaries), apex)
    until = _first_after(span.release, limits)
    if release >= until:
        before = boundaries[bisect_left(boundaries, until) - 1]
        release = max(before if span.release - before <= synchrony().reach else span.release, apex)
    end = min(_after(release, release + offset, boundaries), until) if offset > 0.0 else release
    return MovementPhases(start, apex, release, max(end, release))


def _first_after(time: float, limits: Sequence[float]) -> float:
    index = bisect_right(limits, time)
    return limits[index] if index < len(limits) else math.inf


def lasting(span: MovementPhases, seconds: float, boundaries: Sequence[float]) -> MovementPhases:
    """Return a span that lasts some seconds at least, if needed up to the next boundary within reach.

    It rises for `RISE` of them at least.
    """
    apex = max(span.apex, span.start + RISE * seconds)
    if span.end - span.start >= seconds:
        return MovementPhases(span.start, min(apex, span.release), span.release, span.end)
    index = bisect_left(boundaries, end := span.start + seconds)
    later = boundaries[index] if index < len(boundaries) else math.inf
    end = later if later - end <= synchrony().reach else end
    return MovementPhases(span.start, apex, max(apex, end - (span.end - span.release)), end)


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
