"""Contact goals: lips that must close, and the lower lip that must reach the upper teeth.

Goals are the last step: each segment with a target for `lip_seal` or `lip_tuck` reaches it for its whole
closure, whatever other channels do (DESIGN, section 3; facts: lips, point 10).
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...core.arrays import Array
from ...core.lips.articulators import PROTRUSION, SHORTEST_CLOSURE
from ...core.movement import LipSegment
from ..intervals import ranges
from ..knots import ramp
from .tradeoffs import tradeoffs

SEAL, TUCK = "lip_seal", "lip_tuck"
CONTACTS = (SEAL, TUCK)
SOFT, MOST_SOFT = 0.016, 0.3
"""Seconds in which a contact reaches its speed, and the greatest share of a ramp that they may be."""
GIVES_WAY = 2
"""The power of a tuck by which the seal gives way to it: more than 1, so that the seal comes before the tuck
has gone; with 4 a seal that a display needs came in 10 ms."""


@dataclass(frozen=True, slots=True)
class Goal:
    """A closure: `value` of `contact` during [start, end], with ramps on both sides, seconds.

    `segment`: the index of the segment that has this goal.
    """

    contact: str
    segment: int
    start: float
    end: float
    value: float
    ramp_in: float
    ramp_out: float

    def at(self, time: float) -> float:
        """Return how far this goal is reached at a time."""
        return float(GoalCurve([self]).at(np.array([time]))[0])


def contact_goals(segments: Sequence[LipSegment]) -> tuple[Goal, ...]:
    """Return the goals of the segments, sorted by start; a tuck gives way to the seals beside it."""
    seals = _closures(segments, SEAL)
    tucks = []
    for tuck in _closures(segments, TUCK):
        fitted = _fit(tuck, _late(tuck, segments), _forward(tuck, segments), seals)
        if fitted is not None:
            tucks.append(fitted)
    return tuple(sorted((*seals, *tucks), key=lambda g: (g.start, g.end, g.contact)))


def _closures(segments: Sequence[LipSegment], contact: str) -> list[Goal]:
    table, goals = tradeoffs(), []
    ramp = table.seal.ramp if contact == SEAL else table.tuck.ramp
    for number, segment in enumerate(segments):
        value = segment.targets.get(contact, 0.0)
        if value > 0.0:
            missing = max(0.0, SHORTEST_CLOSURE - (segment.end - segment.start))
            # A release is heard when it is, so a closure that is too short begins earlier.
            start = segment.start - (missing if contact == SEAL else missing / 2.0)
            end = max(segment.end, start + SHORTEST_CLOSURE)
            goals.append(Goal(contact, number, start, end, value, ramp, ramp))
    return sorted(goals, key=_middle)


def _middle(goal: Goal) -> float:
    return (goal.start + goal.end) / 2.0


def _late(tuck: Goal, segments: Sequence[LipSegment]) -> tuple[float, float]:
    """Return start and end of a tuck that leaves rounded segments beside it round at their middles."""
    table = tradeoffs().tuck
    spared = table.waits * (tuck.end - tuck.start)
    start, end = tuck.start, tuck.end
    for before in segments[max(tuck.segment - 1, 0) : tuck.segment]:
        if _is_rounded(before):
            start = max(start, min((before.start + before.end) / 2.0 + table.ramp, start + spared))
    for after in segments[tuck.segment + 1 : tuck.segment + 2]:
        if _is_rounded(after):
            end = min(end, max((after.start + after.end) / 2.0 - table.ramp, end - spared))
    return start, end


def _forward(tuck: Goal, segments: Sequence[LipSegment]) -> float:
    """Return how far, mm, the phones beside a tuck keep the upper lip forward."""
    beside = segments[max(tuck.segment - 1, 0) : tuck.segment + 2]
    return tradeoffs().rounding.remaining * max(max(s.targets.get(PROTRUSION, 0.0), 0.0) for s in beside)


def _is_rounded(segment: LipSegment) -> bool:
    return segment.targets.get(PROTRUSION, 0.0) > 0.0


def _fit(tuck: Goal, wanted: tuple[float, float], forward: float, seals: list[Goal]) -> Goal | None:
    """Place a tuck between the seals around it, at `wanted` if possible; their ramps shorten in place.

    The lips meet across its gap and across what the upper lip is `forward`, mm.
    """
    table = tradeoffs().tuck
    right = bisect_right(seals, _middle(tuck), key=_middle)
    left = right - 1
    free_from = seals[left].end if left >= 0 else -np.inf
    free_to = seals[right].start if right < len(seals) else np.inf
    room, fastest = free_to - free_from, tradeoffs().opening.fastest
    if room < 2.0 * table.gap / fastest:
        return None
    least = min((table.gap + forward) / fastest, room / 2.0)
    middle = min(max(_middle(tuck), free_from + least), free_to - least)
    start = min(max(wanted[0], free_from + table.ramp), middle)
    end = max(min(wanted[1], free_to - table.ramp), middle)
    if left >= 0:
        seals[left] = replace(seals[left], ramp_out=min(seals[left].ramp_out, start - free_from))
    if right < len(seals):
        seals[right] = replace(seals[right], ramp_in=min(seals[right].ramp_in, free_to - end))
    return replace(
        tuck,
        start=start,
        end=end,
        ramp_in=min(table.ramp, start - free_from),
        ramp_out=min(table.ramp, free_to - end),
    )


class GoalCurve:
    """The goals of one contact, evaluated at any times.

    Together goals g close 1 − Π(1 − g). So two closures nearer than their ramps leave a smooth, partial
    opening between them; two that are nearer still leave none, and the vowel between them is lost. `soft`:
    the seconds of a ramp in which it reaches its speed; `most_soft`: their greatest share of it.
    """

    def __init__(self, goals: Sequence[Goal], soft: float = SOFT, most_soft: float = MOST_SOFT) -> None:
        self.goals, self._soft, self._most_soft = tuple(goals), soft, most_soft
        rows = [(g.start, g.end, g.value, g.ramp_in, g.ramp_out) for g in goals]
        table = np.array(rows, dtype=np.float64).reshape(-1, 5).T
        self._start, self._end, self._value, self._ramp_in, self._ramp_out = table

    def at(self, times: Array) -> Array:
        """Return the curve at sorted times, shape (n,), 0 away from all goals."""
        low = np.searchsorted(times, self._start - self._ramp_in, side="left")
        high = np.searchsorted(times, self._end + self._ramp_out, side="right")
        goal, index = ranges(low, high)
        t = times[index]
        early, late = self._start[goal] - t, t - self._end[goal]
        width = np.where(early > late, self._ramp_in[goal], self._ramp_out[goal])
        beyond = np.minimum(np.maximum(np.maximum(early, late), 0.0) / width, 1.0)
        values = self._value[goal] * ramp(1.0 - beyond, np.minimum(self._soft / width, self._most_soft))
        left = np.ones(len(times))
        np.multiply.at(left, index, 1.0 - values)
        return np.asarray(1.0 - left)


def beside_tuck(tuck: Array) -> Array:
    """Return how much of a seal a tuck, 0..1, leaves, shape (n,): 1 − tuck².

    When the lower lip leaves the teeth, the gap at first stays as wide. The seal must come at its own pace
    before the tuck has gone, or the gap would shut at one stroke with the last of it.
    """
    return np.asarray(1.0 - tuck**GIVES_WAY)
