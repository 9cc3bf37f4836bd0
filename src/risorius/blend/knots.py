"""Knots: the times at which curves without a formula are computed.

Knots divide the time between edges (when something starts, ends or changes) evenly, so that results do not
depend on the frame rate and move with their causes. Between knots the curves are straight lines.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ..core.arrays import Array, IndexArray
from ..core.time import TICK

BLOCK = 60.0
"""Seconds of one block of time: knots and frames are computed block by block, so that memory does not grow
with the score. Results depend on it by rounding alone."""


def block_number(time: float) -> int:
    """Return the number of the block in which a time lies."""
    return math.floor(time / BLOCK)


def split_blocks(times: Array, length: float) -> Iterator[tuple[int, slice]]:
    """Yield each part of `length` seconds that holds some of the sorted times, with their place."""
    if not len(times):
        return
    first, last = math.floor(times[0] / length), math.floor(times[-1] / length)
    if first == last:
        yield first, slice(0, len(times))
        return
    numbers = np.floor(times / length)
    edges = np.searchsorted(numbers, np.arange(first, last + 2)).tolist()
    for number, place in zip(range(first, last + 1), map(slice, edges, edges[1:]), strict=True):
        if place.start < place.stop:
            yield number, place


def block_knots(knots: Knots, number: int, margin: float) -> Array:
    """Return the knots of a block and of `margin` seconds on both sides, shape (n,)."""
    return knots.between(number * BLOCK - margin, (number + 1) * BLOCK + margin)


def steps_between(edges: Array, step: float) -> IndexArray:
    """Return into how many steps, none longer than `step`, each stretch between edges (n,) is divided."""
    return np.maximum(np.ceil(np.diff(edges) / step - 1e-6), 1.0).astype(np.intp)


class Knots:
    """Edges, shape (n,), sorted and distinct, with knots at most `step` seconds apart between them.

    `reach`: seconds over which edges have an effect; the middle of a longer stretch is not divided.
    """

    def __init__(self, edges: Array, step: float, reach: float = np.inf) -> None:
        long = np.flatnonzero(np.diff(edges) > 2.0 * reach + step)
        quiet = edges[long] + reach
        self.edges = np.sort(np.concatenate((edges, quiet, edges[long + 1] - reach)))
        self._counts = steps_between(self.edges, step)
        self._counts[np.searchsorted(self.edges, quiet)] = 1

    def between(self, start: float, stop: float) -> Array:
        """Return the knots from the last edge before `start` to the first after `stop`, shape (m,).

        If an edge is more than a block away, the knots begin or end at the one just beyond.
        """
        first = max(int(np.searchsorted(self.edges, start, side="right")) - 1, 0)
        last = min(int(np.searchsorted(self.edges, stop, side="left")), len(self.edges) - 1)
        edges, counts = self.edges[first : last + 1], self._counts[first:last]
        if not len(counts):
            return edges
        widths = np.diff(edges) / counts
        low, high = np.zeros(len(counts), np.intp), counts.copy()
        if start - edges[0] > BLOCK:
            low[0] = min(int((start - edges[0]) / widths[0]), counts[0] - 1)
        if edges[-1] - stop > BLOCK:
            high[-1] = max(counts[-1] - int((edges[-1] - stop) / widths[-1]), int(low[-1]) + 1)
        blocks = high - low
        part = np.arange(int(blocks.sum())) - np.repeat(np.cumsum(blocks) - blocks - low, blocks)
        knots = np.repeat(edges[:-1], blocks) + part * np.repeat(widths, blocks)
        end = edges[-1] if high[-1] == counts[-1] else edges[-2] + high[-1] * widths[-1]
        return np.append(knots, end)


def smooth_interp(times: Array, knots: Array, values: Array) -> Array:
    """Return at some times, shape (n,), the curve of `values` on sorted `knots` (m,), without corners.

    It is straight from knot to knot, and a parabola about each knot, up to the middle of the shorter of the
    stretches beside it. Before the first knot and after the last it keeps their values.
    """
    lengths = np.diff(knots)
    nearest = np.searchsorted(knots[:-1] + 0.5 * lengths, times)
    slopes = np.zeros(len(knots) + 1)
    slopes[1:-1] = np.diff(values) / lengths
    reach = np.zeros(len(knots))
    reach[1:-1] = 0.5 * np.minimum(lengths[1:], lengths[:-1])
    aside, near = times - knots.take(nearest), reach.take(nearest)
    over = np.maximum(near - np.abs(aside), 0.0)
    over *= over * (0.25 / np.maximum(near, TICK))
    curve = values.take(nearest)
    curve += slopes.take(nearest) * (np.minimum(aside, 0.0) - over)
    curve += slopes[1:].take(nearest) * (np.maximum(aside, 0.0) + over)
    return np.asarray(curve)


def smoothstep(x: Array) -> Array:
    """Return 3x² - 2x³ for x in [0, 1]: 0 and 1 at the ends, with slope 0 there."""
    return x * x * (3.0 - 2.0 * x)


SOFT = 0.07
"""The share of a ramp's time in which it reaches its speed; it needs as much again to stop."""
STEEPEST = 1.0 / (1.0 - SOFT)
"""The greatest slope of a ramp, which it has most of the time: so it is hardly longer than necessary."""


def ramp(x: Array, soft: float | Array = SOFT) -> Array:
    """Return a ramp for x in [0, 1]: it rises from 0 to 1 at an even pace, but with slope 0 at both ends.

    `soft`: the share of the time in which it reaches its speed.
    """
    near = np.minimum(x, 1.0 - x)
    steepest = 1.0 / (1.0 - soft)
    risen = steepest * np.where(near < soft, near * near * (0.5 / soft), near - 0.5 * soft)
    return np.where(x < 0.5, risen, 1.0 - risen)


def inverse_ramp(y: Array) -> Array:
    """Return the x in [0, 1] at which the ramp is y in [0, 1]; exactly 1 for 1."""
    risen = np.minimum(y, 1.0 - y) / STEEPEST
    near = np.where(risen < 0.5 * SOFT, np.sqrt(2.0 * SOFT * np.maximum(risen, 0.0)), risen + 0.5 * SOFT)
    return np.where(y < 0.5, near, 1.0 - near)


def rate_limited(times: Array, share: Array, rise: float, fall: float) -> Array:
    """Return the curve below `share`, 0..1, that changes at a limited speed, shape (n,).

    It rises by at most 1 in `rise` seconds, falls by at most 1 in `fall` seconds, and has no kinks at 0 and
    1.
    """
    return ramp(envelope(times, inverse_ramp(share), STEEPEST * rise, STEEPEST * fall))


LEAST_REQUESTED = 0.25
"""A smaller request counts as this much: its share changes over at least this part of the minimum durations,
and never at once."""


def slowed_clock(times: Array, requested: Array) -> Array:
    """Return a clock that runs faster the smaller the request, 0..1, at the `times` is; shape (n,) all.

    On this clock the share of a request has the minimum durations of a muscle from rest to full: half a
    contraction needs half the time.
    """
    most = np.maximum(np.maximum(requested[1:], requested[:-1]), LEAST_REQUESTED)
    return np.append(0.0, np.cumsum(_grains(np.diff(times) / most)))


class KnotWindow:
    """The `width` seconds around each of some sorted times (n,), cut at the first and the last time."""

    def __init__(self, times: Array, width: float) -> None:
        self._times, half = times, 0.5 * width
        self._first = np.maximum(times - half, times[0])
        self._last = np.minimum(times + half, times[-1])
        # Count a time at the very end of a stretch as inside, whatever the rounding.
        low = np.searchsorted(times, self._first - TICK, side="left")
        count = np.searchsorted(times, self._last + TICK, side="right") - low
        # Two ranges whose lengths are powers of two cover each range: their least value is its own.
        powers = np.frexp(count.astype(np.float64))[1] - 1
        self._ranges = []
        for power in range(int(powers.max()) + 1):
            here = np.flatnonzero(powers == power)
            self._ranges.append((here, low[here], low[here] + count[here] - 2**power))

    def average(self, curve: Array) -> Array:
        """Return the average of a curve (n,) around each time, shape (n,): it has no corners.

        A constant stretch of the curve stays exactly as it is.
        """
        area = np.append(0.0, np.cumsum(0.5 * (curve[1:] + curve[:-1]) * np.diff(self._times)))
        spread = np.interp(self._last, self._times, area) - np.interp(self._first, self._times, area)
        average = spread / np.maximum(self._last - self._first, TICK)
        return np.asarray(np.clip(average, self.lowest(curve), -self.lowest(-curve)))

    def lowest(self, curve: Array) -> Array:
        """Return the least value of a curve (n,) around each time, shape (n,)."""
        lowest, least = np.empty(len(curve)), curve
        for power, (here, low, high) in enumerate(self._ranges):
            lowest[here] = np.minimum(least[low], least[high])
            least = np.minimum(least[: -(2**power)], least[2**power :])
        return lowest


def envelope(times: Array, limit: Array, rise: float, fall: float) -> Array:
    """Return the highest curve below `limit` that changes at a limited speed, shape (n,).

    It rises by at most 1 in `rise` seconds and falls by at most 1 in `fall` seconds (0: at once).
    """
    risen = _slowed(times, limit, rise)
    return _slowed(-times[::-1], risen[::-1], fall)[::-1]


def _slowed(times: Array, limit: Array, duration: float) -> Array:
    if duration <= 0.0:
        return limit
    # A change by more than 1 has no effect. Sums of grains are exact, so that far-off values leave no trace.
    steps = np.minimum(np.diff(times) / duration, _FAR)
    slope = np.append(0.0, np.cumsum(_grains(steps)))
    grains = _grains(limit)
    slowed = slope + np.minimum.accumulate(grains - slope)
    return np.where(slowed < grains, slowed, limit)


_GRAIN = 2.0**-36
_FAR = 2.0


def _grains(values: Array) -> Array:
    """Return values as whole multiples of a grain: sums of them are exact in any order."""
    return np.floor(values / _GRAIN) * _GRAIN
