"""How the lips approach closures and leave them: in time, and no faster than lips can.

The opening before a closure falls early enough, the opening after it rises no faster, and a vowel between two
closures opens only as far as the time allows. With d the seconds to the closure before or after,
s(d) = d²/(d + gentle) and V the highest speed, the gap is at most

    B = V·s₁·s₂/(s₁ + s₂)

mm: 0 during closures, V·s beside one, a parabola between two. The numbers are data (`tradeoffs.toml`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array
from ...core.articulators import APERTURE, PROTRUSION, WIDTH
from ..intervals import merged
from .contact import SEAL, TUCK, Goal, GoalCurve
from .tradeoffs import tradeoffs

LEAST_GAP = 0.5
"""mm; a closed gap counts as at least this wide, so that a seal begins gently there too."""

ADDED = 0.5
"""The most that other channels add to the opening of speech, as a share of it; our own choice."""


class Approach:
    """How far the contact goals of a score let the lips open and take their shape."""

    def __init__(self, goals: Sequence[Goal]) -> None:
        self._table = tradeoffs()
        seals = [g for g in goals if g.contact == SEAL and g.value == 1.0]
        tucks = [g for g in goals if g.contact == TUCK]
        gentle = self._table.opening.gentle
        self._seals = _Distance(seals, gentle)
        self._tucks = _Distance(tucks if self._table.before("opening", "tuck") else (), gentle)
        self._partial = GoalCurve([g for g in goals if g.contact == SEAL and g.value < 1.0])
        self._tuck = GoalCurve(tucks if self._table.before("rounding", "tuck") else ())

    def most(self, times: Array) -> Array:
        """Return the widest gap that closures allow at sorted times, mm (perhaps infinite), shape (n,)."""
        return self._table.opening.fastest * self._seals.at(times)

    def sealed(self, targeted: Array, times: Array, gaps: MouthGaps | None) -> Array:
        """Return the seal at sorted times (n,) that keeps the lips near the opening of the `targeted` one."""
        most = self.most(times)
        seal = targeted if gaps is None else gaps.sealed(targeted, most)
        left_open = 1.0 - np.maximum(seal, 1.0 - most / LEAST_GAP)
        return np.asarray(1.0 - left_open * (1.0 - self._partial.at(times)))

    def reached(self, average: Callable[[str], Array], times: Array) -> Callable[[str], Array]:
        """Return a function like `average`, with the averages of targets as far as the goals allow."""
        averages: dict[str, Array] = {}

        def average_of(name: str) -> Array:
            if name not in averages:
                averages[name] = self._reached(name, average(name), times)
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
        speech_gap = self.alone * (1.0 - targeted)
        extra = np.maximum(self.with_others - self.alone, 0.0)
        room = np.maximum(most - speech_gap, 0.0)
        taken = _taken(extra, room)
        taken += self.speaking * (_taken(extra, np.minimum(room, ADDED * speech_gap)) - taken)
        closed = self.alone - speech_gap + taken
        return np.asarray(np.clip(closed / np.maximum(self.with_others, LEAST_GAP), 0.0, 1.0))


def _taken(extra: Array, room: Array) -> Array:
    """Return e − e·r/(e + r), what must be closed of the gap e if there is room for r."""
    return np.divide(extra * extra, extra + room, out=np.zeros(len(extra)), where=extra > 0.0)


class _Distance:
    """The eased distance in time to the goals on both sides: s₁·s₂/(s₁ + s₂), seconds."""

    def __init__(self, goals: Sequence[Goal], gentle: float) -> None:
        spans = merged(np.array([(g.start, g.end) for g in goals], dtype=np.float64).reshape(-1, 2))
        self._start, self._end = np.append(spans[:, 0], np.inf), np.append(-np.inf, spans[:, 1])
        self._gentle = gentle

    def at(self, times: Array) -> Array:
        """Return the distance at sorted times, shape (n,): 0 during goals, infinite if there are none."""
        number = np.searchsorted(self._start, times, side="right")
        before, ahead = times - self._end[number], self._start[number] - times
        with np.errstate(divide="ignore"):
            return 1.0 / (self._slowness(before) + self._slowness(ahead))

    def _slowness(self, distance: Array) -> Array:
        """Return 1/s = 1/d + gentle/d²."""
        near = 1.0 / np.maximum(distance, 0.0)
        return near + self._gentle * near * near


def smooth_minimum(a: Array, b: Array, width: float) -> Array:
    """Return the lesser of two curves, rounded off by at most width/4 near their crossings."""
    near = np.maximum(width - np.abs(a - b), 0.0)
    return np.asarray(np.minimum(a, b) - near * near * (0.25 / width))
