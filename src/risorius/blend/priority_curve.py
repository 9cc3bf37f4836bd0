"""The priority of a channel over time: a step function."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from ..core.arrays import Array
from .intervals import Spans, intersection, share, union

PRIORITY_RAMP = 0.12
"""Seconds over which a change of priority takes effect if nothing else smooths it: a lip's minimum."""


@dataclass(frozen=True, slots=True)
class PriorityClaim:
    """The priority that one movement claims for its channel.

    `priority` holds from `start` to `release`, `release_priority` from there to `end`, unless a movement that
    started later is still under way. Seconds.
    """

    start: float
    release: float
    end: float
    priority: float
    release_priority: float


@dataclass(frozen=True, slots=True)
class PriorityCurve:
    """Priorities `values` (n,), each from its own time of `times` (n,) to the next; the first is -inf."""

    times: Array
    values: Array

    @property
    def constant(self) -> float | None:
        """The one priority, or None if it changes."""
        return float(self.values[0]) if len(self.values) == 1 else None

    @property
    def distinct(self) -> tuple[float, ...]:
        """All priorities, highest first."""
        return tuple(float(v) for v in np.unique(self.values)[::-1])

    def equal(self, other: PriorityCurve) -> bool:
        """Return whether others are the same priorities at the same times."""
        return np.array_equal(self.times, other.times) and np.array_equal(self.values, other.values)

    def at(self, times: Array) -> Array:
        """Return the priority at each time, shape (n,)."""
        return self.values[np.searchsorted(self.times, times, side="right") - 1]

    def spans(self, level: float) -> Spans:
        """Return when the priority is `level`, shape (m, 2)."""
        ends = np.concatenate((self.times[1:], [np.inf]))
        at_level = self.values == level
        return np.column_stack((self.times[at_level], ends[at_level]))

    def weight(self, level: float, times: Array) -> Array:
        """Return 1 while the priority is `level`, else 0, with ramps after each change; shape (n,)."""
        if self.constant is not None:
            return np.full(len(times), float(level == self.constant))
        return share(self.spans(level), times, PRIORITY_RAMP)


def steady(priority: float) -> PriorityCurve:
    """Return a priority that never changes."""
    return PriorityCurve(np.array([-np.inf]), np.array([priority], dtype=np.float64))


def priority_curve(claims: Iterable[PriorityClaim], default: float) -> PriorityCurve:
    """Return a channel's priority: that of its latest-started movement under way, else the last one's.

    Before the first movement it is the first one's; without movements, `default`.
    """
    ordered = sorted(claims, key=lambda c: c.start)
    if not ordered:
        return steady(default)
    if all(c.priority == c.release_priority == ordered[0].priority for c in ordered):
        return steady(ordered[0].priority)
    times = sorted({t for c in ordered for t in (c.start, c.release, c.end)})
    values = _sweep(ordered, times)
    changes = [0] + [i for i in range(1, len(times)) if values[i] != values[i - 1]]
    starts = [-np.inf, *(times[i] for i in changes[1:])]
    return PriorityCurve(np.array(starts), np.array([values[i] for i in changes], dtype=np.float64))


def _sweep(ordered: list[PriorityClaim], times: list[float]) -> list[float]:
    """Return the priority from each time to the next: that of the latest-started movement under way."""
    values: list[float] = []
    current = ordered[0].priority
    under_way: list[PriorityClaim] = []
    waiting = iter(ordered)
    following = next(waiting, None)
    for t in times:
        while following is not None and following.start <= t:
            under_way.append(following)
            following = next(waiting, None)
        while under_way and under_way[-1].end <= t:
            under_way.pop()
        if under_way:
            top = under_way[-1]
            current = top.release_priority if t >= top.release else top.priority
        values.append(current)
    return values


def outranking(a: PriorityCurve, b: PriorityCurve) -> Spans:
    """Return when the priority `a` is higher than `b`, shape (n, 2)."""
    return union(
        [intersection(a.spans(high), b.spans(low)) for high in a.distinct for low in b.distinct if high > low]
    )


def outranks(a: PriorityCurve, b: PriorityCurve, times: Array) -> Array:
    """Return 1 while priority `a` is higher than `b`, else 0, with ramps after each change; shape (n,)."""
    if a.constant is not None and b.constant is not None:
        return np.full(len(times), float(a.constant > b.constant))
    return share(outranking(a, b), times, PRIORITY_RAMP)
