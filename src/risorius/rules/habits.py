"""Habits: a speaker's movements that no rule asks for, by ids like those of rules.

The numbers of habits stand in profiles. A user's file of rules changes them for every profile, or deletes a
habit, in the form of rules (paper B, section 3.2).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from ..errors import InputError, ParameterError, unknown
from ..reading.frozen import FrozenDict
from .profiles import Profile
from .tuned import nested, numbers_of

T = TypeVar("T")
HABITS: Mapping[str, str] = FrozenDict(
    {
        "manipulators.lids.natural": "blinks",
        "manipulators.lids.itti": "blinks",
        "manipulators.lids.pelachaud": "blinks",
        "gaze.lids.shift": "blinks",
        "gaze.aversion.habit": "gaze",
        "gaze.scan.face": "gaze",
        "head.noise.idle": "head",
        "head.melody.pitch": "head",
        "head.posture.speaker": "posture",
        "emotion.posture.speaker": "posture",
    }
)
"""The part of a profile that holds the numbers of each habit."""


@dataclass(frozen=True, slots=True)
class Habit:
    """Numbers of a habit in place of a profile's: by key below the habit's part, as `interval.0`."""

    id: str
    numbers: Mapping[str, float]
    source: str
    comment: str = ""

    def __post_init__(self) -> None:
        if self.id not in HABITS:
            raise ParameterError(unknown("habit", self.id, HABITS))


@dataclass(frozen=True, slots=True)
class HabitChanges:
    """Changes of habits in files of rules: other numbers, in order, and deletions."""

    changed: tuple[Habit, ...] = ()
    deleted: frozenset[str] = field(default_factory=frozenset)

    def __bool__(self) -> bool:
        return bool(self.changed or self.deleted)


def with_habits(profile: Profile, changes: HabitChanges) -> Profile:
    """Return a profile with habits changed and deleted.

    Raises ParameterError for a number that the profile lacks, InputError for one out of its range.
    """
    for habit in changes.changed:
        profile = _changed(profile, habit)
    for name in changes.deleted:
        profile = _without(profile, name)
    return profile


def _changed(profile: Profile, habit: Habit) -> Profile:
    part = HABITS[habit.id]
    known = {number.key: number for number in numbers_of(profile)}
    keys = {f"{part}.{key}": value for key, value in habit.numbers.items()}
    for key, value in keys.items():
        if key not in known:
            own = [k.removeprefix(f"{part}.") for k in known if k.startswith(f"{part}.")]
            raise ParameterError(unknown(f"number of {habit.id}", key.removeprefix(f"{part}."), own))
        low, high = known[key].low, known[key].high
        if (low is not None and value < low) or (high is not None and value > high):
            raise InputError(f"{habit.id}: {key} = {value:g} is out of range; expected {low} to {high}")
    return _merged(profile, nested(profile, keys))


def _merged(item: T, changes: Mapping[str, Any]) -> T:
    """Return a dataclass with the values of nested tables in place of its own."""
    values: dict[str, Any] = {}
    for name, value in changes.items():
        own = getattr(item, name)
        if dataclasses.is_dataclass(own):
            values[name] = _merged(own, value)
        elif isinstance(own, Mapping):
            values[name] = FrozenDict({**own, **value})
        else:
            values[name] = tuple(value) if isinstance(value, list) else value
    return replace(item, **values)  # type: ignore[type-var]


def _without(profile: Profile, name: str) -> Profile:
    """Return a profile without a habit."""
    blinks, gaze, head = profile.blinks, profile.gaze, profile.head
    if name == "gaze.lids.shift":
        return replace(profile, blinks=replace(blinks, shift=0.0))
    if name.startswith("manipulators."):
        model = name.rpartition(".")[2]
        return replace(profile, blinks=replace(blinks, model="none")) if blinks.model == model else profile
    if name == "gaze.aversion.habit":
        return replace(profile, rates=FrozenDict({**profile.rates, name: 0.0}))
    if name == "gaze.scan.face":
        return replace(profile, gaze=replace(gaze, scan_pitch=0.0, scan_yaw=0.0))
    if name == "head.noise.idle":
        return replace(profile, head=replace(head, pitch=0.0, yaw=0.0, roll=0.0))
    if name == "head.melody.pitch":
        return replace(profile, head=replace(head, melody=0.0))
    turns = name == "head.posture.speaker"
    kept = {n: v for n, v in profile.posture.items() if n.startswith("head_") is not turns}
    return replace(profile, posture=FrozenDict(kept))


def deleted_by(prefixes: Iterable[str]) -> frozenset[str]:
    """Return the habits whose ids are one of the prefixes, or begin with one up to a dot."""
    return frozenset(
        name for name in HABITS for prefix in prefixes if name == prefix or name.startswith(prefix + ".")
    )
