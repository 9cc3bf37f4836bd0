"""The approach of the lips to closures, and their opening after them: in time, and no faster than lips can.

The opening before a closure falls early enough, the opening after it rises no faster, and a vowel between two
closures opens only as far as the time allows. With d the seconds to the closure before or after and V the
highest speed, the gap is at most

    B = V·d₁·d₂/(d₁ + d₂)

mm: V·d beside a closure, a parabola between two, and below 0 in a closure, by the seconds to its start and
end: lips meet at full speed, because their goal lies beyond contact (Löfqvist and Gracco 1997). Beside a tuck
s(d) = d²/(d + gentle) takes the place of d. The numbers are data (`tradeoffs.toml`). A closure farther away
than `FAR` counts for nothing: what is said much later changes no opening.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from ...core.arrays import Array
from ...core.functions import positive_part
from ...core.lips.articulators import APERTURE, JAW, PROTRUSION, SEAL_MM, WIDTH
from ...core.lips.lip_rig import seal_of
from ..intervals import merged
from ..knots import smoothstep
from .contact import SEAL, TUCK, Goal, GoalCurve
from .tradeoffs import tradeoffs

EARLY = 0.003
"""Seconds by which lips meet before a closure and part after it: the rounding of the open rest still
leaves some tenths of a millimetre where they meet."""
WITHIN = 0.03
"""Seconds in which the seal of a closure comes to shut any gap, however wide; within the closure if that is
twice as long."""

NEAR, FAR = 0.3, 0.55
"""Seconds to a closure up to which it counts wholly, and from which on it counts for nothing: so far from one
the lips have time for any opening."""
CHIN = 0.3
"""mm that the chin stays higher for each mm by which closures keep the lips from opening: half of its part in
an opening (facts: lips-motion, 9), for it is slower than they. With its whole part it went up and down with
the lips as no captured chin does."""
ADDED = 0.5
"""The most that other channels add to the opening of speech, as a share of it; our own choice."""


ROUNDED, PARTED, WIDEST = 4.0, 5.0, 100.0
"""mm over which the open rest and other channels' additions are rounded at 0, and a gap wider than all."""
TINY = 1e-12
"""No curve turns over less than this."""


class ClosureSpeedLimit:
    """The limits that the contact goals of a score set to the lips' opening and shape."""

    def __init__(self, goals: Sequence[Goal]) -> None:
        self._table = tradeoffs()
        seals = [g for g in goals if g.contact == SEAL and g.value == 1.0]
        tucks = [g for g in goals if g.contact == TUCK]
        gentle = self._table.opening.gentle
        self._seals = _Distance([(g.start - EARLY, g.end + EARLY) for g in seals], 0.0)
        self._shut = GoalCurve([_shutting(g) for g in seals], soft=WITHIN, most_soft=0.5)
        kept_near = tucks if self._table.before("opening", "tuck") else ()
        self._tucks = _Distance([(g.start, g.end) for g in kept_near], gentle)
        self._partial = GoalCurve([g for g in goals if g.contact == SEAL and g.value < 1.0])
        self._tuck = GoalCurve(tucks if self._table.before("rounding", "tuck") else ())

    def most(self, times: Array) -> Array:
        """Return the widest gap that closures allow at sorted times, mm, shape (n,).

        It is infinite without closures, and below 0 during a closure.
        """
        return self._table.opening.fastest * (self._seals.at(times) - self._seals.inside(times))

    def sealed(self, targeted: Array, times: Array, gaps: MouthGaps | None) -> Array:
        """Return the seal at sorted times (n,) that keeps the lips near the opening of the `targeted` one."""
        seal = targeted if gaps is None else gaps.sealed(targeted, self.most(times))
        left_open = (1.0 - seal) * (1.0 - self._shut.at(times))
        return np.asarray(1.0 - left_open * (1.0 - self._partial.at(times)))

    def reached(self, average: Callable[[str], Array], times: Array) -> Callable[[str], Array]:
        """Return a function like `average`, with the averages of targets as far as the goals allow."""
        averages: dict[str, Array] = {}
        own = cache(average)  # an average that is asked for again is computed again

        def average_of(name: str) -> Array:
            if name not in averages:
                averages[name] = self._reached(name, own(name), times)
                if name == JAW:
                    asked, left = (
                        positive_part(gap, self._table.opening.rounded)
                        for gap in (own(APERTURE), average_of(APERTURE))
                    )
                    averages[name] = averages[name] - CHIN * (asked - left)
            return averages[name]

        return average_of

    def _reached(self, name: str, value: Array, times: Array) -> Array:
        if name == APERTURE:
            opening = self._table.opening
            beside_tucks = self._table.tuck.gap + opening.fastest * self._tucks.at(times)
            value = smooth_minimum(value, beside_tucks, opening.rounded)
            return smooth_minimum(value, self.most(times), opening.rounded)
        if name in (WIDTH, PROTRUSION):
            return value * (1.0 - (1.0 - self._table.rounding.remaining) * self._tuck.at(times))
        return value


@dataclass(frozen=True, slots=True)
class MouthGaps:
    """The lips' gap without any seal, mm: of speech `alone`, and `with_others`, shape (n,) both.

    `speaking` 0..1 (n,): how much the mouth speaks.
    """

    alone: Array
    with_others: Array
    speaking: Array

    def sealed(self, targeted: Array, most: Array) -> Array:
        """Return the seal, shape (n,), that keeps the gap below `most` mm (n,), given the `targeted` seal.

        If speech leaves a gap a, the gap e that other channels add is reduced to e·r/(e + r); r is what a
        lacks to `most`, in speech at most `ADDED`·a. So wide phones stay wide, narrow ones narrow.
        """
        speech_gap = self.alone - SEAL_MM * targeted
        extra = positive_part(self.with_others - self.alone, PARTED)
        room = positive_part(np.minimum(most, WIDEST) - speech_gap, ROUNDED)
        taken = _taken(extra, room)
        taken += self.speaking * (
            _taken(extra, lesser(room, ADDED * positive_part(speech_gap, ROUNDED))) - taken
        )
        open_alone = np.maximum(speech_gap, 0.0)
        more = seal_of(SEAL_MM * targeted + taken, open_alone + extra - taken)
        # Only by how much the seal grows: a targeted one is rounded already, and stays if nothing is taken.
        more -= seal_of(SEAL_MM * targeted, open_alone)
        return np.asarray(np.clip(targeted + more, 0.0, 1.0))


def _taken(extra: Array, room: Array) -> Array:
    """Return e − e·r/(e + r), the part of the gap e that must be closed if there is room for r."""
    return np.divide(extra * extra, extra + room, out=np.zeros(len(extra)), where=extra > 0.0)


def _shutting(goal: Goal) -> Goal:
    """Return the times in which the seal of a closure is 1, with the ramps to it."""
    inner = min(WITHIN, 0.5 * (goal.end - goal.start))
    start, end = goal.start + inner, goal.end - inner
    return Goal(goal.contact, goal.segment, start, end, goal.value, WITHIN, WITHIN)


class _Distance:
    """The eased distance in time to the goals on both sides: s₁·s₂/(s₁ + s₂), seconds.

    `goals`: when each starts and ends.
    """

    def __init__(self, goals: Sequence[tuple[float, float]], gentle: float) -> None:
        spans = merged(np.array(goals, dtype=np.float64).reshape(-1, 2))
        self._start, self._end = np.append(spans[:, 0], np.inf), np.append(-np.inf, spans[:, 1])
        self._gentle = gentle

    def at(self, times: Array) -> Array:
        """Return the distance at sorted times, shape (n,): 0 during goals, infinite without goals."""
        number = np.searchsorted(self._start, times, side="right")
        before, ahead = times - self._end[number], self._start[number] - times
        with np.errstate(divide="ignore"):
            return 1.0 / (self._slowness(before) + self._slowness(ahead))

    def inside(self, times: Array) -> Array:
        """Return the same to the ends of a goal at sorted times, shape (n,): 0 outside all goals."""
        number = np.searchsorted(self._start, times, side="right")
        start = np.append(np.inf, self._start[:-1])[number]
        since, until = np.maximum(times - start, 0.0), np.maximum(self._end[number] - times, 0.0)
        both, distance = since + until, np.zeros(len(times))
        np.divide(since * until, both, out=distance, where=both > 0.0)
        return distance

    def _slowness(self, distance: Array) -> Array:
        """Return 1/s = 1/d + gentle/d², which fades to 0 from `NEAR` to `FAR`."""
        near = 1.0 / np.maximum(distance, 0.0)
        near *= smoothstep(np.clip((FAR - distance) / (FAR - NEAR), 0.0, 1.0))
        return near + self._gentle * near * near if self._gentle else near


def lesser(a: Array, b: Array) -> Array:
    """Return about the lesser of two curves of 0 or more, without a corner: a·b/(a⁴ + b⁴)^¼."""
    greater = np.maximum(a, b)
    share = np.divide(np.minimum(a, b), greater, out=np.zeros(np.shape(greater)), where=greater > 0.0)
    return np.asarray(share * greater / (1.0 + share**4) ** 0.25)


def smooth_maximum(a: Array, b: Array, width: float) -> Array:
    """Return the greater of two curves of 0 or more, rounded off by at most width/4 near their crossings.

    If one is smaller than `width` it is rounded off by less, and not at all beside a curve at rest.
    """
    least = np.minimum(np.minimum(a, b), width)
    near = np.maximum(least - np.abs(a - b), 0.0)
    return np.asarray(np.maximum(a, b) + near * near * (0.25 / np.maximum(least, TINY)))


def smooth_minimum(a: Array, b: Array, width: float) -> Array:
    """Return the lesser of two curves, rounded off by at most width/4 near their crossings."""
    near = np.maximum(width - np.abs(a - b), 0.0)
    return np.asarray(np.minimum(a, b) - near * near * (0.25 / width))
