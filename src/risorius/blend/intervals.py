"""Sets of times as sorted, disjoint intervals: arrays of shape (n, 2), start and end in seconds.

The combination of channels computes with such sets instead of frames, so that it does not depend on the
frame rate. Ends may be infinite. Curves cross between ticks, so that an interval may be shorter than a tick:
it comes from rounding and is dropped, for an inhibition in it would have effects long before and after.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.arrays import Array, BoolArray, IndexArray
from ..core.time import TICK

Spans = Array
"""A set of times: sorted, disjoint intervals (n, 2), seconds."""

Extent = tuple[float, float, tuple[float | str | bytes, ...]]
"""The start and end of a part of a curve, seconds, and all that distinguishes it from other parts."""

EMPTY: Spans = np.zeros((0, 2))
EMPTY.setflags(write=False)


def merged(intervals: Spans) -> Spans:
    """Return the set that unsorted, perhaps overlapping intervals cover, shape (n, 2)."""
    return _covered((intervals,), 1) if len(intervals) else EMPTY


def union(sets: Sequence[Spans]) -> Spans:
    """Return the times that lie in any of the sets, shape (n, 2)."""
    filled = [s for s in sets if len(s)]
    if not filled:
        return EMPTY
    return filled[0] if len(filled) == 1 else _covered(filled, 1)


def intersection(a: Spans, b: Spans) -> Spans:
    """Return the times that lie in both sets, shape (n, 2)."""
    return _covered((a, b), 2) if len(a) and len(b) else EMPTY


def difference(a: Spans, b: Spans) -> Spans:
    """Return the times of `a` that lie outside `b`, shape (n, 2)."""
    return intersection(a, complement(b)) if len(a) and len(b) else a


def complement(a: Spans) -> Spans:
    """Return all other times, shape (n, 2), from minus to plus infinity."""
    edges = np.concatenate(([-np.inf], a.ravel(), [np.inf])).reshape(-1, 2)
    return edges[edges[:, 0] < edges[:, 1]]


def dilated(a: Spans, left: float, right: float) -> Spans:
    """Return the set with every interval grown by `left` seconds backwards and `right` forwards."""
    return _covered((a + np.array([-left, right]),), 1) if len(a) else EMPTY


def _covered(sets: Sequence[Spans], needed: int) -> Spans:
    """Return the times that at least `needed` sets cover; intervals that touch join."""
    starts = np.concatenate([s[:, 0] for s in sets])
    ends = np.concatenate([s[:, 1] for s in sets])
    times = np.concatenate((starts, ends))
    order = np.argsort(times, kind="stable")  # of equal times, starts come first
    inside = np.cumsum(np.where(order < len(starts), 1, -1)) >= needed
    entered = inside & ~np.concatenate(([False], inside[:-1]))
    left = ~inside & np.concatenate(([False], inside[:-1]))
    return _lasting(times[order[entered]], times[order[left]])


def _lasting(starts: Array, ends: Array) -> Spans:
    lasting = ends - starts > TICK
    return np.column_stack((starts[lasting], ends[lasting]))


def neighbours(a: Spans, times: Array) -> tuple[Array, Array]:
    """Return for each time how long ago the last interval ended and how soon the next begins, (n,) both.

    Seconds, infinite if there is no such interval. Inside the set the first is 0 or negative.
    """
    k = np.searchsorted(a[:, 0], times, side="right")
    ends = np.concatenate(([-np.inf], a[:, 1]))
    starts = np.concatenate((a[:, 0], [np.inf]))
    return times - ends[k], starts[k] - times


def covers(a: Spans, times: Array) -> BoolArray:
    """Return whether each time lies in the set, its ends included, shape (n,)."""
    since, until = neighbours(a, times)
    return np.asarray((since <= 0.0) | (until <= 0.0))


def ranges(low: IndexArray, high: IndexArray) -> tuple[IndexArray, IndexArray]:
    """Return every index from low to high (exclusive) of each range, one range after the other.

    `low`, `high`: shape (n,). Returns the number of the range and the index, both shape (m,).
    """
    count = np.maximum(high - low, 0)
    owner = np.repeat(np.arange(len(count)), count)
    return owner, np.arange(len(owner)) + np.repeat(low - (np.cumsum(count) - count), count)


def share(a: Spans, times: Array, width: float) -> Array:
    """Return the share of [t - width, t] that the set covers, 0..1, shape (n,): a ramp for every step."""
    if not len(a) or not len(times):
        return np.zeros(len(times))
    clipped = np.clip(a, times.min() - width, times.max())
    before = np.concatenate(([0.0], np.cumsum(clipped[:, 1] - clipped[:, 0])))

    def covered(t: Array) -> Array:
        k = np.searchsorted(clipped[:, 0], t, side="right")
        last = np.maximum(k - 1, 0)
        excess = np.maximum(clipped[last, 1] - t, 0.0)
        return np.asarray(np.where(k > 0, before[k] - excess, 0.0))

    return np.clip((covered(times) - covered(times - width)) / width, 0.0, 1.0)


def above_line(times: Array, values: Array, threshold: float) -> Spans:
    """Return when the line through (times, values), each (n,), lies above `threshold`, shape (m, 2)."""
    high = values > threshold
    edges = np.flatnonzero(high[1:] != high[:-1])
    t0, t1, v0, v1 = times[edges], times[edges + 1], values[edges], values[edges + 1]
    return spans_between(times, high, t0 + (t1 - t0) * (threshold - v0) / (v1 - v0))


def spans_between(times: Array, high: BoolArray, crossings: Array) -> Spans:
    """Return the intervals during which `high` (n,) is true, shape (m, 2).

    `crossings`: when it changes, one time for each change between two `times`.
    """
    if not len(times):
        return EMPTY
    edges = [crossings]
    if high[0]:
        edges.insert(0, times[:1])
    if high[-1]:
        edges.append(times[-1:])
    bounds = np.concatenate(edges)
    return _lasting(bounds[0::2], bounds[1::2])
