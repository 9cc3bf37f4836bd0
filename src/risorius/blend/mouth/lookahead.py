"""Lip segments blended by looking ahead (paper B, section 4.3; Kent and Minifie 1977).

Three rules give every segment its posture T[s] of each articulator, and when it holds:

1. Look-ahead. A segment may yield an articulator (`LipSegment.yields`) from some rate of speech on: then it
   takes the posture of the next segment that does not yield it, if no silence comes first, else of the last
   such segment before it. So lips round for a vowel as soon as no segment before it needs another shape. The
   segments that yield follow the clusters of Jeffers and Barley (1971): in fast speech fewer stay distinct.
2. Geometric constraint. If an articulator goes from one side of rest to the other, each posture is scaled by
   1 − OPPOSED·o/(|T[s]| + o), with o the larger opposite neighbour. Lips that round beside lips that spread
   are one action against another, each of one phone or several, whatever its articulators: width and
   protrusion are scaled by 1 − SPOILED·(o₁ + o₂)/2, with o₁ and o₂ the width of the actions before and after
   as a share of /i/'s or /u/'s, at most 1, and 0 if a silence or lips at rest come first.
3. Temporal constraint. From one posture to the next an articulator needs as long as its muscle needs to
   contract (if |T| grows) or to relax: D, the minimum onset or offset of the parameter table, and longer for
   a long way, so that it is never faster than `FASTEST`. The step S[s](t) rises by minimum jerk over D around
   the boundary before s. The weight of s is S[s] − S[s + 1]: the lips do not reach a phone shorter than D,
   and the posture before it remains.

A step to or from a closure (an aperture below zero) is no longer than the vowel beside it, so that the vowel
is seen; `approach` keeps the lips shut for the whole closure. Steps begin and end in the order of their
boundaries, so that no weight is negative.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...core.arrays import Array, BoolArray, IndexArray
from ...core.functions import minimum_jerk
from ...core.lips.articulators import APERTURE, ARTICULATORS, PROTRUSION, WIDTH, leader
from ...core.movement import LipSegment
from ...core.parameters import BASES, INDEX, PARAMETERS, Parameter
from ...core.speech.utterance import SILENCE
from ..intervals import ranges
from .coarticulation import (
    LIP_MODELS,
    SegmentValues,
    SegmentWeights,
    SharedMappings,
    weighted_averages,
)

OPPOSED = 0.3
"""Twice the share of a posture that an equal and opposite neighbour takes away."""
SPOILED = 0.24
"""The share of rounded or spread lips that opposite actions on both sides take away."""
WIDEST, NARROWEST = 1.5, 12.0
"""mm: how much wider than at rest the mouth is in /i/, and how much narrower in /u/."""
FASTEST = 160.0
"""mm/s at the peak of a step; the speeds of two close steps add up. People reach 150 to 310."""
_PEAK = 1.875
"""The peak speed of minimum jerk divided by its mean speed."""
SHORTEST_STEP = 0.085
"""Seconds: a vowel between two closures that is much shorter is lost."""
FASTEST_BETWEEN = 250.0
"""mm/s at the peak of a step that is shortened for a vowel between two closures."""
NEIGHBOURS = 2
"""Segments on either side over which the rate of speech is measured."""


@LIP_MODELS.register("lookahead")
class LookAheadModel:
    """Coarticulation by looking ahead (see `coarticulation.Coarticulation`)."""

    def __init__(self, segments: Sequence[LipSegment]) -> None:
        self._aims = SharedMappings([s.targets for s in segments])
        self._yields = SharedMappings([s.yields for s in segments])
        self._start = np.array([s.start for s in segments])
        self._end = np.array([s.end for s in segments])
        self._silent = np.array([s.phone == SILENCE for s in segments])
        self._rate = _rates(self._end - self._start, self._silent)
        self._names: list[str] = []
        self._targets: dict[str, Array] = {}
        self._steps: dict[int, tuple[Array, Array]] = {}
        slowest = max(max(p.min_onset, p.min_offset) for p in PARAMETERS)
        widest = max(a.high - a.low for a in ARTICULATORS.values())
        self.reach = max(slowest, _PEAK / FASTEST * widest)

    def group(self, parameter: str) -> int:
        """Return the number of the articulator that a parameter follows, or of the parameter itself."""
        name = leader(parameter)
        if name not in self._names:
            self._names.append(name)
        return self._names.index(name)

    def targets(self, parameter: str) -> Array:
        """Return each segment's posture after rules 1 and 2, shape (segments,)."""
        if parameter not in self._targets:
            posture = self._ahead(parameter)
            if parameter in (WIDTH, PROTRUSION):
                scale = _rounding_left(self._ahead(WIDTH), self._silent)
            else:
                scale = _opposition_left(posture)
            self._targets[parameter] = posture * scale
        return self._targets[parameter]

    def _ahead(self, parameter: str) -> Array:
        """Return each segment's posture after rule 1, shape (segments,)."""
        own = self._aims.column(parameter, 0.0)
        yields_from = self._yields.column(parameter, np.nan)
        yields_from = np.where(np.isnan(yields_from), self._yields.column("*", np.inf), yields_from)
        return own[_sources(~self._silent & (self._rate >= yields_from), self._silent)]

    def weights(self, group: int, times: Array) -> SegmentWeights:
        """Return the weight of each segment at sorted times."""
        if group not in self._steps:
            self._steps[group] = self._steps_of(self._names[group])
        start, end = self._steps[group]
        leaves, left = np.append(start[1:], np.inf), np.append(end[1:], np.inf)
        first = int(np.searchsorted(left, times[0], side="left"))
        last = int(np.searchsorted(start, times[-1], side="right"))
        chosen = np.arange(first, max(last, first + 1))
        low = np.searchsorted(times, start[chosen], side="left")
        high = np.searchsorted(times, left[chosen], side="right")
        owner, time = ranges(low, high)
        segment, t = chosen[owner], times[time]
        weight = _step(t, start[segment], end[segment]) - _step(t, leaves[segment], left[segment])
        return SegmentWeights(segment, time, np.maximum(weight, 0.0), len(times))

    def averages(self, group: int, values: Sequence[SegmentValues], times: Array) -> list[Array]:
        """Return the averages of some values by the weights at sorted times, shape (n,) each."""
        return weighted_averages(self, group, values, times)

    def _steps_of(self, name: str) -> tuple[Array, Array]:
        """Return when the step to each segment begins and ends; the first one is before all times."""
        posture = self.targets(name)
        size, muscle = np.abs(posture), _muscle(name)
        needed = np.where(size[1:] > size[:-1], muscle.min_onset, muscle.min_offset)
        if name in ARTICULATORS:
            needed = np.maximum(needed, _PEAK / FASTEST * np.abs(np.diff(posture)))
        boundary = (self._end[:-1] + self._start[1:]) / 2.0
        if name == APERTURE:
            needed = self._between_closures(posture, needed)
        start = np.minimum.accumulate((boundary - needed / 2.0)[::-1])[::-1]
        end = np.maximum.accumulate(boundary + needed / 2.0)
        return np.append(-np.inf, start), np.append(-np.inf, end)

    def _between_closures(self, posture: Array, needed: Array) -> Array:
        """Return the lengths of the steps; one to or from a closure is no longer than the phone beside it."""
        closed = posture < 0.0
        duration = self._end - self._start
        closing, opening = closed[1:] & ~closed[:-1], closed[:-1] & ~closed[1:]
        room = np.where(closing, duration[:-1], np.where(opening, duration[1:], np.inf))
        least = np.maximum(SHORTEST_STEP, _PEAK / FASTEST_BETWEEN * np.abs(np.diff(posture)))
        return np.minimum(needed, np.maximum(room, least))


def _muscle(name: str) -> Parameter:
    """Return the muscle whose minimum durations an articulator has, or the parameter itself."""
    articulator = ARTICULATORS.get(name)
    return BASES[articulator.follow[0]][0] if articulator is not None else PARAMETERS[INDEX[name]]


def _rates(durations: Array, silent: BoolArray) -> Array:
    """Return the phones per second around each segment, without silences, shape (segments,)."""
    window = np.ones(2 * NEIGHBOURS + 1)
    spoken = np.convolve(~silent, window, mode="full")[NEIGHBOURS:-NEIGHBOURS]
    seconds = np.convolve(np.where(silent, 0.0, durations), window, mode="full")[NEIGHBOURS:-NEIGHBOURS]
    return np.asarray(np.divide(spoken, seconds, out=np.zeros(len(durations)), where=seconds > 0.0))


def _sources(yields: BoolArray, silent: BoolArray) -> IndexArray:
    """Return the segment whose posture each takes: itself, the next that does not yield, or the last."""
    count = np.arange(len(yields))
    last = np.maximum.accumulate(np.where(yields, 0, count))
    following = np.where(yields, len(yields) - 1, count)
    following = np.minimum.accumulate(following[::-1])[::-1]
    after = np.where(silent[following], last, following)
    return np.where(silent[after], count, after)


def _opposition_left(posture: Array) -> Array:
    """Return the factor of each posture by rule 2, but for width and protrusion."""
    around = np.stack([np.append(0.0, posture[:-1]), np.append(posture[1:], 0.0)])
    opposite = np.maximum(-around * np.sign(posture), 0.0).max(axis=0)
    total = np.abs(posture) + opposite
    share = np.divide(opposite, total, out=np.zeros(len(posture)), where=total > 0.0)
    return np.asarray(1.0 - OPPOSED * share)


def _rounding_left(width: Array, silent: BoolArray) -> Array:
    """Return the factor of each segment's width and protrusion by rule 2.

    Segments in a row on one side of rest are one action: as wide or narrow as the most of them.
    """
    side = np.where(silent, 0.0, np.sign(width))
    first = np.flatnonzero(np.diff(side, prepend=np.nan))
    size = np.maximum.reduceat(np.abs(width), first) / np.where(side[first] > 0.0, WIDEST, NARROWEST)
    action = side[first] * np.minimum(size, 1.0)
    around = np.stack([np.append(0.0, action[:-1]), np.append(action[1:], 0.0)])
    opposite = np.maximum(-around * np.sign(action), 0.0).mean(axis=0)
    return np.repeat(1.0 - SPOILED * opposite, np.diff(np.append(first, len(width))))


def _step(times: Array, start: Array, end: Array) -> Array:
    """Return the steps at their times: 0 before `start`, 1 after `end`."""
    with np.errstate(invalid="ignore"):
        share = (times - start) / (end - start)
    share = np.where(np.isneginf(end), 1.0, np.where(np.isposinf(start), 0.0, share))
    return minimum_jerk(np.clip(share, 0.0, 1.0))
