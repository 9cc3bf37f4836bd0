"""Lip segments blended by dominance (Cohen and Massaro 1993; paper A, section 5.1).

Segment s has over parameter p the dominance

    D(t) = α·exp(-(x/τ)^c)

with x the distance in time beyond its plateau, and τ before or after it; the curve is ΣD·target / ΣD. The
paper prints e^(-θ·τ^c), without magnitude, plateau and sides (facts: science/01, section 1.1): α = 1, a
plateau of 0 and θ = τ^(-c) on both sides give that. With c = 1 the curve has kinks at the plateaus' ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, IndexArray, UInt32Array
from ...core.movement import Dominance, LipSegment
from ..intervals import ranges
from .coarticulation import (
    LIP_MODELS,
    SHORTEST_SILENCE,
    ParameterGroups,
    SegmentValues,
    SegmentWeights,
    SharedMappings,
    weighted_averages,
)

NEGLIGIBLE = 21.0
"""The natural logarithm of a ratio of dominances: a weight of e^-21, 8e-10, is left out."""
SHORTEST = 0.005
"""The shortest time constant, seconds: with a shorter one a segment would be a step."""


@dataclass(frozen=True, slots=True)
class _Columns:
    """Dominance of segments over one group of parameters; arrays of shape (segments,), seconds.

    `flat`: half the plateau; `reach_before`, `reach_after`: how far beyond it the weight is not negligible;
    `felt_until`: when the last of the segments so far ends to have weight.
    """

    centre: Array
    flat: Array
    magnitude: Array
    before: Array
    after: Array
    exponent: Array
    reach_before: Array
    reach_after: Array
    felt_until: Array


@LIP_MODELS.register("dominance")
class DominanceModel:
    """Coarticulation by dominance (see `coarticulation.Coarticulation`)."""

    def __init__(self, segments: Sequence[LipSegment]) -> None:
        self._numbers: dict[Dominance, int] = {}
        # Segments of one class share their dominance: it is looked up once for all of them.
        self._dominances = SharedMappings([s.dominance for s in segments])
        self._first = self._dominances.first(segments)
        self._aims = SharedMappings([s.targets for s in segments])
        self._groups = ParameterGroups(self._row_of)
        self._spans = np.array([(s.start, s.end) for s in segments], dtype=np.float64)
        self._ended = np.maximum.accumulate(self._spans[:, 1])
        self.reach = self._longest_reach()

    def _longest_reach(self) -> float:
        """Return how far any segment has weight beyond its ends, seconds."""
        half = float(np.diff(self._spans, axis=1).max()) / 2.0 if len(self._spans) else 0.0
        every = [d for by_parameter in self._dominances.mappings for d in by_parameter.values()]
        table = np.array([_row(d) for d in {*every, Dominance()}])
        spans = np.tile([-half, half], (len(table), 1))
        columns = _columns(spans, table)
        return float(max(columns.reach_before.max(), columns.reach_after.max()))

    def group(self, parameter: str) -> int:
        """Return the number of the group of parameters over which each segment has one dominance."""
        return self._groups.number(parameter)

    def _row_of(self, parameter: str) -> UInt32Array:
        """Return the number of each segment's dominance: long clips take little memory."""
        numbers = [self._number(s.dominance_of(parameter)) for s in self._first]
        return np.array(numbers, dtype=np.uint32)[self._dominances.number]

    def _number(self, dominance: Dominance) -> int:
        return self._numbers.setdefault(dominance, len(self._numbers))

    def targets(self, parameter: str) -> Array:
        """Return each segment's target, 0 if it has none, shape (segments,)."""
        return self._aims.column(parameter, 0.0)

    def weights(self, group: int, times: Array) -> SegmentWeights:
        """Return the dominance of each segment, divided by their sum, at sorted times."""
        near = self._near(times[0], times[-1])
        table = np.array([_row(d) for d in self._numbers])
        d = _columns(self._spans[near], table[self._groups.rows[group][near]])
        first = int(np.searchsorted(d.felt_until, times[0], side="left"))
        starts = d.centre - d.flat - d.reach_before
        chosen = np.arange(first, len(starts))[starts[first:] <= times[-1]]
        low = np.searchsorted(times, starts[chosen], side="left")
        high = np.searchsorted(times, (d.centre + d.flat + d.reach_after)[chosen], side="right")
        owner, time = ranges(low, high)
        segment = chosen[owner]
        weight = _relative(_dominance(d, segment, times[time]), time, len(times))
        return SegmentWeights(near.start + segment, time, weight, len(times))

    def averages(self, group: int, values: Sequence[SegmentValues], times: Array) -> list[Array]:
        """Return the averages of some values by the weights at sorted times, shape (n,) each."""
        return weighted_averages(self, group, values, times)

    def _near(self, first: float, last: float) -> slice:
        """Return the segments that may have weight at times from `first` to `last`."""
        begin = np.searchsorted(self._ended, first - self.reach, side="left")
        return slice(int(begin), int(np.searchsorted(self._spans[:, 0], last + self.reach, side="right")))


def _row(d: Dominance) -> tuple[float, ...]:
    return d.magnitude, d.before, d.after, d.exponent, d.plateau


def _columns(spans: Array, dominances: Array) -> _Columns:
    """Return the columns for segments' starts and ends (segments, 2) and their dominances (segments, 5)."""
    centre, half = spans.mean(axis=1), np.diff(spans, axis=1)[:, 0] / 2.0
    magnitude, before, after, exponent, plateau = dominances.T
    before, after = np.maximum(before, SHORTEST), np.maximum(after, SHORTEST)
    flat = half * plateau
    # The least dominance of a segment that covers a time or is next to a gap.
    least = _logarithm(magnitude) - ((half - flat + SHORTEST_SILENCE) / np.minimum(before, after)) ** exponent
    lowest = least[magnitude > 0.0].min(initial=0.0)
    fall = np.maximum(_logarithm(magnitude) - lowest + NEGLIGIBLE, 0.0) ** (1.0 / exponent)
    reach_before, reach_after = before * fall, after * fall
    felt_until = np.maximum.accumulate(centre + flat + reach_after)
    return _Columns(centre, flat, magnitude, before, after, exponent, reach_before, reach_after, felt_until)


def _logarithm(magnitude: Array) -> Array:
    return np.log(np.maximum(magnitude, 1e-300))


def _dominance(d: _Columns, segment: IndexArray, times: Array) -> Array:
    """Return the natural logarithm of the dominance of each segment at its time, shape (n,)."""
    offset = times - d.centre[segment]
    tau = np.where(offset < 0.0, d.before[segment], d.after[segment])
    x = np.maximum(np.abs(offset) - d.flat[segment], 0.0) / tau
    exponent = d.exponent[segment]
    fall = x if np.all(exponent == 1.0) else x**exponent
    return np.asarray(np.where(d.magnitude > 0.0, _logarithm(d.magnitude), -np.inf)[segment] - fall)


def _relative(logarithm: Array, time: IndexArray, count: int) -> Array:
    """Return weights that sum to 1 at each time, or to 0, from logarithms, shape (n,).

    Far from all segments every dominance is too small for a number, but not their ratios.
    """
    highest = np.full(count, -np.inf)
    np.maximum.at(highest, time, logarithm)
    highest = np.where(np.isneginf(highest), 0.0, highest)
    weight = np.exp(logarithm - highest[time])
    total = np.bincount(time, weight, count)
    return np.asarray(weight / np.where(total > 0.0, total, 1.0)[time])
