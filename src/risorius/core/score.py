"""The score: all movements of a performance, before they are combined."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Annotated

from ..errors import InputError
from ..reading.hints import Range
from .choices import CONFLICT, CONTACT, LIPS, ROUNDING
from .functions import FunctionName
from .lips.articulators import check_lip_target
from .movement import (
    LipSegment,
    ManualCurve,
    Movement,
    check_movement,
    check_shapes,
    check_span,
    check_target,
)
from .time import put_on_ticks
from .units import MAX_SECONDS, Share

NotNegative = Annotated[float, Range(0.0)]
MOST_ROUNDING = 0.1
"""Seconds; a phone lasts hardly longer."""


@dataclass(frozen=True, slots=True)
class BlendSettings:
    """The settings by which movements are combined.

    `activation_threshold`, `min_onset` and `min_offset` override the parameter table for all muscles, and
    `onset_function` overrides the movements' own, unless None. `contact`: whether the lips' contact goals
    hold. `lips`: the coarticulation model. `rounding`: seconds over which corners of curves are rounded off;
    0 keeps the curves of paper A.
    """

    conflict: str = CONFLICT.score
    activation_threshold: Share | None = None
    min_onset: NotNegative | None = None
    min_offset: NotNegative | None = None
    onset_function: FunctionName | None = None
    contact: bool = CONTACT.score
    lips: str = LIPS.score
    rounding: Annotated[float, Range(0.0, MOST_ROUNDING)] = ROUNDING.score


@dataclass(frozen=True, slots=True)
class Score:
    """Movements, lip segments and hand-drawn curves over [0, duration] seconds, read to the nearest tick."""

    duration: float
    movements: tuple[Movement, ...] = ()
    lips: tuple[LipSegment, ...] = ()
    manual: tuple[ManualCurve, ...] = ()
    settings: BlendSettings = field(default_factory=BlendSettings)
    text: str = ""
    seed: int = 0

    def __post_init__(self) -> None:
        put_on_ticks(self, "duration")

    def __repr__(self) -> str:
        """Return one line: how long it is, and how much it holds."""
        counts = {"movements": self.movements, "lip segments": self.lips, "drawn curves": self.manual}
        content = ", ".join(f"{len(parts)} {name}" for name, parts in counts.items() if parts)
        return f"<Score of {self.duration:.2f} s, {content or 'empty'}>"


def check_score(score: Score, like: Score | None = None) -> None:
    """Raise InputError or ParameterError, with the movement's name, if a score cannot be performed.

    Movements that it shares with `like`, which has been checked, are not checked again one by one.
    """
    check_course(score)
    checked_movements = set() if like is None else {id(m) for m in like.movements}
    for m in score.movements:
        if id(m) not in checked_movements:
            check_movement(m)
    # Segments of one phone share their mappings.
    checked: set[int] = set()
    for segment in score.lips:
        check_span(f"phone {segment.phone or 'silence'}", segment.start, segment.end)
        if id(segment.targets) not in checked:
            checked.add(id(segment.targets))
            for name, value in segment.targets.items():
                check_lip_target(name, value)
        if id(segment.limits) not in checked:
            checked.add(id(segment.limits))
            _check_limits(segment)
    for curve in score.manual:
        _check_manual(curve)


def check_course(score: Score) -> None:
    """Raise InputError for a duration out of range, and if movements of one layer start together."""
    if not 0.0 < score.duration <= MAX_SECONDS:
        expected = f"more than 0 and at most {MAX_SECONDS:g} seconds"
        raise InputError(f"duration = {score.duration} is out of range; expected {expected}")
    check_sequence(score.movements)


def _check_limits(segment: LipSegment) -> None:
    for name, (low, high) in segment.limits.items():
        check_target(name, low)
        check_target(name, high)
        if low > high:
            raise InputError(f"phone '{segment.phone}': limits of {name} are reversed: {low} > {high}")


def check_sequence(movements: tuple[Movement, ...]) -> None:
    """Raise InputError if two movements start together in one layer of a channel."""
    seen: dict[tuple[str, str, float], Movement] = {}
    for m in movements:
        key = (m.channel, m.layer, m.start)
        if key in seen:
            raise InputError(
                f"movements '{seen[key].label}' and '{m.label}' both start at {m.start:g} s "
                f"in channel {m.channel}; movements of one channel follow one another"
            )
        seen[key] = m


def _check_manual(curve: ManualCurve) -> None:
    for name, keys in curve.keys.items():
        if not keys:
            raise InputError(f"manual curve of {name} has no keys; expected [[time, value], …]")
        for time, value in keys:
            check_target(name, value)
            if not abs(time) <= MAX_SECONDS:
                expected = f"at most {MAX_SECONDS:g} seconds from the start"
                raise InputError(
                    f"manual curve of {name}: time = {time} is out of range; expected {expected}"
                )
        if any(not a[0] < b[0] for a, b in pairwise(keys)):
            raise InputError(f"manual curve of {name}: times must increase from key to key")
    check_shapes(curve)
