"""One entry of a score's `movements`: an ordinary movement, a lip segment or hand-drawn curves."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal, TypeVar

from ...core.action_units import in_parameters, read_targets
from ...core.channels import CHANNELS
from ...core.functions import DEFAULT_FUNCTION
from ...core.key_shapes import KeyShape
from ...core.lips.articulators import ARTICULATORS, check_lip_target
from ...core.movement import (
    Cause,
    Dominance,
    LipSegment,
    ManualCurve,
    Movement,
    check_movement,
    check_shapes,
    check_span,
    check_target,
)
from ...core.parameters import parameters_named
from ...core.units import MAX_SECONDS, Seconds
from ...errors import InputError, ParameterError, RisoriusError, unknown
from ...reading.hints import ChooseType, Range, Then
from ...reading.json_text import JsonObject
from ...reading.schema import MisfitError
from ..layout import to_record

V = TypeVar("V")
NumberPair = tuple[float, float]
KeyTime = Annotated[float, Range(-MAX_SECONDS, MAX_SECONDS)]
YieldRate = Annotated[float, Range(0.0)]
"""Phones a second."""
Precision = Annotated[float, Range(0.0, 1000.0)]
_ANY = "*"  # for all targets that are not named


def _checked(movement: Movement) -> Movement:
    check_movement(movement)
    return movement


def _by_parameter(values: Mapping[str, V], check: Callable[[str, V], object]) -> dict[str, V]:
    """Replace aliases and names without a side by the parameters that they mean, each checked."""
    by_name: dict[str, V] = {}
    for name, value in values.items():
        try:
            for parameter in parameters_named(name):
                if parameter.name in by_name:
                    raise InputError(f"{parameter.name} is given twice; expected it once")
                check(parameter.name, value)
                by_name[parameter.name] = value
        except RisoriusError as error:
            raise MisfitError(error.message, name, kind=type(error)) from None
        except MisfitError as misfit:
            misfit.path = (name, *misfit.path)
            raise
    return by_name


def _lip_targets(targets: Mapping[str, float]) -> dict[str, float]:
    """Return targets that are articulators, in mm, as they stand; others as those of a movement."""
    articulators = {name: value for name, value in targets.items() if name in ARTICULATORS}
    for name, value in articulators.items():
        try:
            check_lip_target(name, value)
        except RisoriusError as error:
            raise MisfitError(error.message, name, kind=type(error)) from None
    others = {name: value for name, value in targets.items() if name not in articulators}
    return articulators | dict(in_parameters(read_targets(others)))


def _limits(limits: Mapping[str, NumberPair]) -> dict[str, NumberPair]:
    return _by_parameter(limits, _check_limits)


def _check_limits(parameter: str, pair: NumberPair) -> None:
    low, high = pair
    check_target(parameter, low)
    check_target(parameter, high)
    if low > high:
        raise InputError(f"the limits are reversed: {low:g} > {high:g}; expected the lower one first")


def _by_lip_target(values: Mapping[str, V]) -> dict[str, V]:
    """Return values by articulator, by "*" and by parameter."""
    named = {name: value for name, value in values.items() if name == _ANY or name in ARTICULATORS}
    others = {name: value for name, value in values.items() if name not in named}
    return named | _by_parameter(others, lambda _name, _value: None)


def _rising(keys: tuple[NumberPair, ...]) -> tuple[NumberPair, ...]:
    if not keys:
        raise InputError("there are no keys; expected [[time, value], …]")
    for number, (key, before) in enumerate(zip(keys[1:], keys, strict=False), 1):
        if key[0] <= before[0]:
            message = f"time {key[0]:g} does not come after {before[0]:g}; expected rising times"
            raise MisfitError(message, number)
    return keys


def _curves(curves: Mapping[str, tuple[NumberPair, ...]]) -> dict[str, tuple[NumberPair, ...]]:
    return _by_parameter(curves, _check_keys)


def _shapes(shapes: Mapping[str, tuple[KeyShape, ...]]) -> dict[str, tuple[KeyShape, ...]]:
    return _by_parameter(shapes, lambda _name, _value: None)


def _check_keys(parameter: str, keys: tuple[NumberPair, ...]) -> None:
    for number, (_, value) in enumerate(keys):
        try:
            check_target(parameter, value)
        except RisoriusError as error:
            raise MisfitError(error.message, number, kind=type(error)) from None


@dataclass(frozen=True, slots=True)
class LipsEntry:
    """A lip segment as a file has it."""

    channel: Literal["lips"]
    phone: str
    start: Seconds
    end: Seconds
    targets: Annotated[Mapping[str, float], Then(_lip_targets)]
    limits: Annotated[Mapping[str, NumberPair], Then(_limits)] = field(default_factory=dict)
    dominance: Annotated[Mapping[str, Dominance], Then(_by_lip_target)] = field(default_factory=dict)
    yields: Annotated[Mapping[str, YieldRate], Then(_by_lip_target)] = field(default_factory=dict)
    precision: Annotated[Mapping[str, Precision], Then(_by_lip_target)] = field(default_factory=dict)
    cause: Cause = field(default_factory=Cause)

    def segment(self) -> LipSegment:
        """Return the segment; raise InputError if it does not end after its start."""
        check_span(f"phone {self.phone or 'silence'}", self.start, self.end)
        return LipSegment(
            self.phone,
            self.start,
            self.end,
            self.targets,
            self.limits,
            self.dominance,
            self.cause,
            self.yields,
            self.precision,
        )


@dataclass(frozen=True, slots=True)
class ManualEntry:
    """Curves drawn by hand as a file has them."""

    channel: Literal["manual"]
    keys: Annotated[Mapping[str, Annotated[tuple[tuple[KeyTime, float], ...], Then(_rising)]], Then(_curves)]
    shapes: Annotated[Mapping[str, tuple[KeyShape, ...]], Then(_shapes)] = field(default_factory=dict)
    replaces: bool = False
    cause: Cause = field(default_factory=Cause)

    def curve(self) -> ManualCurve:
        """Return the curves; raise MisfitError if the shapes are not those of their keys."""
        curve = ManualCurve(self.keys, self.cause, self.replaces, self.shapes)
        try:
            check_shapes(curve)
        except InputError as error:
            raise MisfitError(error.message, "shapes") from None
        return curve


def _kind_of(members: Mapping[str, Any]) -> Any:
    """Return the kind of an entry by its keys: with `phone` a lip segment, with `keys` a manual curve."""
    channel = members.get("channel")
    if isinstance(channel, str) and channel not in CHANNELS:
        raise MisfitError(unknown("channel", channel, CHANNELS), "channel", kind=ParameterError)
    if channel == "lips" and ("phone" in members or "onset" not in members):
        return Annotated[LipSegment, Then(LipsEntry.segment, of=LipsEntry)]
    if channel == "manual" and ("keys" in members or "onset" not in members):
        return Annotated[ManualCurve, Then(ManualEntry.curve, of=ManualEntry)]
    return Annotated[Movement, Then(_checked)]


Entry = Annotated[Movement | LipSegment | ManualCurve, ChooseType(_kind_of)]
"""Targets may be action units, aliases and names without side."""


def entry_to_json(entry: Movement | LipSegment | ManualCurve) -> JsonObject:
    """Return a movement, lip segment or manual curve as an object, without fields at their defaults."""
    if isinstance(entry, Movement):
        return _movement_to_json(entry)
    if isinstance(entry, LipSegment):
        return _lips_to_json(entry)
    keys = {name: [list(key) for key in keys] for name, keys in entry.keys.items()}
    shapes = {name: [_shape_to_json(shape) for shape in shapes] for name, shapes in entry.shapes.items()}
    bent = {"shapes": shapes} if shapes else {}
    replaces = {"replaces": True} if entry.replaces else {}
    return {"channel": "manual", "keys": keys} | bent | replaces | _cause_to_json(entry.cause)


def _shape_to_json(shape: KeyShape) -> JsonObject:
    fields: JsonObject = {"before": shape.before, "after": shape.after, "hold": shape.hold}
    return {
        name: list(v) if isinstance(v, tuple) else v for name, v in fields.items() if v not in (None, False)
    }


def _movement_to_json(m: Movement) -> JsonObject:
    optional: JsonObject = {
        "priority": m.priority,
        "release_priority": m.release_priority,
        "function": None if m.function == DEFAULT_FUNCTION else m.function,
    }
    return {
        **({"id": m.id} if m.id else {}),
        "channel": m.channel,
        **({"layer": m.layer} if m.layer else {}),
        "start": m.start,
        "end": m.end,
        "onset": m.onset,
        "offset": m.offset,
        **{name: value for name, value in optional.items() if value is not None},
        **({"on_top": True} if m.on_top else {}),
        "targets": dict(m.targets),
        **_cause_to_json(m.cause),
    }


def _lips_to_json(segment: LipSegment) -> JsonObject:
    limits = {name: list(pair) for name, pair in segment.limits.items()}
    dominance = {name: to_record(value) for name, value in segment.dominance.items()}
    return {
        "channel": "lips",
        "phone": segment.phone,
        "start": segment.start,
        "end": segment.end,
        "targets": dict(segment.targets),
        **({"limits": limits} if limits else {}),
        **({"dominance": dominance} if dominance else {}),
        **({"yields": dict(segment.yields)} if segment.yields else {}),
        **({"precision": dict(segment.precision)} if segment.precision else {}),
        **_cause_to_json(segment.cause),
    }


def _cause_to_json(cause: Cause) -> JsonObject:
    record = to_record(cause)
    return {"cause": record} if record else {}
