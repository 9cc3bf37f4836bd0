"""Lip segments blended by dominance (Cohen and Massaro 1993; paper A, section 5.1).

Each segment has a dominance over each parameter that is full around its centre and falls on both sides as
magnitude·exp(-(x/tau)^c); the curve is the average of the targets with these weights (facts: science/01,
section 1.1). Three additions avoid kinks and effects over long distances: the fall starts gently, it ends at
a finite reach, and it starts at most `MARGIN` inside the segment's edge, so that a long silence or vowel
gives way near its neighbour, not from its own middle on.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, IndexArray, UInt32Array
from ...core.movement import Dominance, LipSegment
from ...errors import InputError
from ..intervals import ranges
from .coarticulation import LIP_MODELS, SHORTEST_SILENCE, SegmentWeights, SharedMappings

MARGIN = 0.08
"""Seconds inside a segment's edge; there, at the latest, dominance begins to fall."""
REACH = 6.0
"""Time constants after which dominance has ended."""
SOFTNESS = 0.5
"""Time constants over which the fall begins; 0 would make a kink."""
SHORTEST = 0.005
"""The shortest time constant, seconds: with a shorter one a segment would be a step."""


@dataclass(frozen=True, slots=True)
class _Columns:
    """Dominance of every segment over one group of parameters; arrays of shape (segments,), seconds."""

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
        self._groups: dict[bytes, int] = {}
        self._numbers: dict[Dominance, int] = {}
        # Segments of one class share their dominance: it is looked up once for all of them.
        self._dominances = SharedMappings([s.dominance for s in segments])
        self._first = self._dominances.first(segments)
        self._aims = SharedMappings([s.targets for s in segments])
        self._group_of: dict[str, int] = {}
        # Per group and segment only the number of the dominance is stored: long clips take little memory.
        self._rows: list[UInt32Array] = []
        self._spans = np.array([(s.start, s.end) for s in segments], dtype=np.float64)
        self._ended = np.maximum.accumulate(self._spans[:, 1])
        for segment in self._first:
            for dominance in segment.dominance.values():
                _check(segment, dominance)
        longest = [
            max(d.before, d.after)
            for by_parameter in self._dominances.mappings
            for d in by_parameter.values()
        ]
        slowest = max([*longest, Dominance().before, Dominance().after])
        self.reach = max(REACH * slowest, 2.0 * MARGIN + SHORTEST_SILENCE)

    def group(self, parameter: str) -> int:
        """Return the number of the group of parameters over which each segment has one dominance."""
        if parameter not in self._group_of:
            numbers = (self._number(s.dominance_of(parameter)) for s in self._first)
            rows = np.array(list(numbers), dtype=np.uint32)[self._dominances.number]
            key = rows.tobytes()
            if key not in self._groups:
                self._groups[key] = len(self._rows)
                self._rows.append(rows)
            self._group_of[parameter] = self._groups[key]
        return self._group_of[parameter]

    def _number(self, dominance: Dominance) -> int:
        return self._numbers.setdefault(dominance, len(self._numbers))

    def targets(self, parameter: str) -> Array:
        """Return each segment's target, 0 if it has none, shape (segments,)."""
        return self._aims.column(parameter, 0.0)

    def weights(self, group: int, times: Array) -> SegmentWeights:
        """Return the dominance of each segment, divided by their sum, at sorted times."""
        near = self._near(times[0], times[-1])
        table = np.array([(d.magnitude, d.before, d.after, d.exponent, d.plateau) for d in self._numbers])
        d = _columns(self._spans[near], table[self._rows[group][near]])
        first = int(np.searchsorted(d.felt_until, times[0], side="left"))
        starts = d.centre - d.flat - d.reach_before
        chosen = np.arange(first, len(starts))[starts[first:] <= times[-1]]
        low = np.searchsorted(times, starts[chosen], side="left")
        high = np.searchsorted(times, (d.centre + d.flat + d.reach_after)[chosen], side="right")
        owner, time = ranges(low, high)
        segment = chosen[owner]
        weight = _dominance(d, segment, times[time])
        total = np.bincount(time, weight, len(times))
        weight /= np.where(total > 0.0, total, 1.0)[time]
        return SegmentWeights(near.start + segment, time, weight, len(times))

    def _near(self, first: float, last: float) -> slice:
        """Return the segments that may have weight at times from `first` to `last`."""
        begin = np.searchsorted(self._ended, first - self.reach, side="left")
        return slice(int(begin), int(np.searchsorted(self._spans[:, 0], last + self.reach, side="right")))


def _columns(spans: Array, dominances: Array) -> _Columns:
    """Return the columns for segments' starts and ends (segments, 2) and their dominances (segments, 5)."""
    centre, half = spans.mean(axis=1), np.diff(spans, axis=1)[:, 0] / 2.0
    magnitude, before, after, exponent, plateau = dominances.T
    before, after = np.maximum(before, SHORTEST), np.maximum(after, SHORTEST)
    flat = np.maximum(half * plateau, half - MARGIN)
    # Wide enough to cover the segment and a gap, so that at every time some segment has weight.
    least = 2.0 * (half - flat) + SHORTEST_SILENCE
    reach_before = np.maximum(REACH * before, least)
    reach_after = np.maximum(REACH * after, least)
    felt_until = np.maximum.accumulate(centre + flat + reach_after)
    return _Columns(centre, flat, magnitude, before, after, exponent, reach_before, reach_after, felt_until)


def _dominance(d: _Columns, segment: IndexArray, times: Array) -> Array:
    """Return the dominance of each segment at its time, shape (n,)."""
    offset = times - d.centre[segment]
    early = offset < 0.0
    tau = np.where(early, d.before[segment], d.after[segment])
    reach = np.where(early, d.reach_before[segment], d.reach_after[segment])
    x = np.maximum(np.abs(offset) - d.flat[segment], 0.0)
    soft = x * x / (x + SOFTNESS * tau)
    exponent = d.exponent[segment]
    fall = soft / tau if np.all(exponent == 1.0) else (soft / tau) ** exponent
    taper = np.maximum(1.0 - (x / reach) ** 2, 0.0)
    return d.magnitude[segment] * np.exp(-np.minimum(fall, 600.0)) * taper * taper


def _check(segment: LipSegment, d: Dominance) -> None:
    values = (d.magnitude, d.before, d.after, d.exponent, d.plateau)
    if not (all(0.0 <= v < float("inf") for v in values) and d.exponent > 0.0 and d.plateau <= 1.0):
        raise InputError(
            f"phone '{segment.phone}' at {segment.start:g} s: dominance {d} is out of range; expected "
            "magnitude, before, after of 0 or more, exponent above 0, plateau 0 to 1"
        )
