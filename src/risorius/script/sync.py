"""Sync points of BML's behaviours: references to others' become times, or places in the speech."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from ..core.units import MAX_SECONDS
from ..errors import InputError, Place, unknown
from .anchor import NUMBER, Anchor, Base, parse_number
from .elements import Attribute
from .quote import one_line, quoted

_REFERENCE = re.compile(
    r"(?<![\w.-])(?:(?P<block>[\w.-]++):)?(?P<behaviour>[\w.-]++):(?P<point>\w++)"
    rf"(?:\s*+(?P<sign>[+-])\s*+(?P<offset>{NUMBER}))?",
    re.ASCII,
)
BLOCK = "bml"
LONGEST_CHAIN = 100  # references that lead from one to the next before one has a time
Point = tuple[str, str]


@dataclass(frozen=True, slots=True)
class Reference:
    """`seconds` after a sync point of a behaviour; of none: after the block's start."""

    point: Point | None
    seconds: float
    place: Place


def read_reference(attribute: Attribute) -> Reference:
    """Return a sync attribute: seconds, `speech1:start`, `gaze1:ready+0.5`, `bml:start`.

    Raises InputError, with its place, for other text.
    """
    value = attribute.value.strip()
    seconds = parse_number(value)
    if seconds is not None:
        if seconds < 0.0:
            raise InputError(f"{attribute.name} = {quoted(value)} is before the start", attribute.place)
        if seconds > MAX_SECONDS:
            expected = f"at most {MAX_SECONDS:g} seconds"
            raise InputError(f"{attribute.name} = {quoted(value)}; expected {expected}", attribute.place)
        return Reference(None, seconds, attribute.place)
    match = _REFERENCE.fullmatch(value)
    if match is None:
        shown = f"{one_line(attribute.name)} = {quoted(value)}"
        message = f"{shown} is not a sync reference; expected e.g. 1.5 or speech1:start+0.5"
        raise InputError(message, attribute.place)
    offset = float(f"{match['sign']}{match['offset']}") if match["offset"] else 0.0
    point = None if match["behaviour"] == BLOCK else (match["behaviour"], match["point"])
    return Reference(point, offset, attribute.place)


@dataclass
class Behaviour:
    """A behaviour's sync points: those given, and `shape`: all of them in seconds after its start.

    Between two given points the shape stretches; beyond them it keeps its length.
    """

    name: str
    place: Place
    shape: Mapping[str, float]
    given: dict[str, Reference] = field(default_factory=dict)
    # Points that lie in the speech, or at the end of the performance.
    fixed: Mapping[str, Anchor] = field(default_factory=dict)


class Timetable:
    """Resolves references; raises InputError, with the place, for one to nothing and for a cycle."""

    def __init__(self, behaviours: Mapping[str, Behaviour]) -> None:
        self._behaviours = behaviours
        self._known: dict[Point, Anchor] = {}
        self._open: list[Point] = []

    def anchor(self, behaviour: str, point: str) -> Anchor:
        """Return when a sync point of a behaviour is reached."""
        return self._anchor((behaviour, point), self._behaviours[behaviour].place)

    def _anchor(self, point: Point, place: Place) -> Anchor:
        if point in self._known:
            return self._known[point]
        if point in self._open:
            chain = [*self._open[self._open.index(point) :], point]
            shown = " → ".join(":".join(p) for p in chain)
            raise InputError(
                f"a cycle of sync references: {shown}; expected one of them to have a time", place
            )
        if len(self._open) == LONGEST_CHAIN:
            message = f"a chain of more than {LONGEST_CHAIN} sync references; expected times in between"
            raise InputError(message, place)
        self._open.append(point)
        anchor = self._found(point, place)
        self._open.pop()
        self._known[point] = anchor
        return anchor

    def _found(self, point: Point, place: Place) -> Anchor:
        name, sync = point
        if name not in self._behaviours:
            raise InputError(unknown("behaviour", one_line(name), self._behaviours or ("none",)), place)
        behaviour = self._behaviours[name]
        if sync in behaviour.fixed:
            return behaviour.fixed[sync]
        if sync not in behaviour.shape:
            known = (*behaviour.fixed, *behaviour.shape)
            raise InputError(unknown(f"sync point of '{name}'", one_line(sync), known), place)
        if sync in behaviour.given:
            return self._referred(behaviour.given[sync])
        return self._shaped(behaviour, sync)

    def _referred(self, reference: Reference) -> Anchor:
        if reference.point is None:
            return Anchor(Base.START, reference.seconds, place=reference.place)
        anchor = self._anchor(reference.point, reference.place).after(reference.seconds)
        return replace(anchor, place=reference.place)

    def _shaped(self, behaviour: Behaviour, sync: str) -> Anchor:
        """Return a point that is not given from those that are: by the shape, stretched between two."""
        shape, timed_points = behaviour.shape, [p for p in behaviour.shape if p in behaviour.given]
        if not timed_points:
            return Anchor(Base.START, shape[sync], place=behaviour.place)
        before = next((p for p in reversed(timed_points) if shape[p] <= shape[sync]), None)
        after = next((p for p in timed_points if shape[p] >= shape[sync]), None)
        near = before if before is not None else after
        assert near is not None
        base = self._anchor((behaviour.name, near), behaviour.place)
        if before is None or after is None or before == after:
            return base.after(shape[sync] - shape[near])
        end = self._anchor((behaviour.name, after), behaviour.place)
        if not base.same_base(end) or shape[after] == shape[before]:
            # How far apart they are is not known before the speech is: as far as the shape says.
            return base.after(shape[sync] - shape[before])
        share = (shape[sync] - shape[before]) / (shape[after] - shape[before])
        return base.after(share * (end.seconds - base.seconds))
