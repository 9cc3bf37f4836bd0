"""The markup's elements: the meaning of their attributes.

A new element is a function from attributes to marks and its line in `ELEMENTS`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

from ..core.action_units import in_parameters, kept_units
from ..core.channels import CHANNELS
from ..core.functions import ONSET_FUNCTIONS
from ..core.parameters import INDEX, PARAMETERS, Kind
from ..core.units import MAX_SECONDS
from ..errors import RisoriusError
from ..rules.markup import TurnAttitude, markup_table
from .anchor import Anchor, Base
from .attributes import Attributes
from .gestures import take_gesture
from .model import Mark, MarkKind
from .quote import one_line
from .targets import take_emotions, take_targets

# Attributes of every mark. `time`, `duration` and `end` come first: they are the likeliest guesses.
COMMON = (
    "time", "duration", "end", "onset", "offset", "priority", "release_priority", "layer", "function",
)  # fmt: skip
_LABEL = 80
# Lips are segments of speech, manual curves are keys: raw movements go to the other channels.
_MARKED_CHANNELS = tuple(name for name in CHANNELS if CHANNELS.get(name).marks)


@dataclass(frozen=True, slots=True)
class _Common:
    """The attributes that every mark has, before its length is known."""

    attributes: Attributes
    label: str
    time: Anchor | None
    duration: float | None
    end: Anchor | None
    onset: float | None
    offset: float | None
    priority: float | None
    release_priority: float | None
    layer: str
    function: str | None

    def mark(
        self,
        kind: MarkKind,
        channel: str,
        targets: Mapping[str, float],
        span: tuple[Anchor, Anchor],
    ) -> Mark:
        """Return the mark of these attributes."""
        return Mark(
            kind,
            channel,
            *span,
            targets,
            self.label,
            self.attributes.place,
            self.onset,
            self.offset,
            self.priority,
            self.release_priority,
            self.layer,
            self.function,
        )

    def lasting(self, seconds: float | None = None) -> tuple[Anchor, Anchor]:
        """Return start and end of an event that lasts `seconds` unless it says otherwise."""
        if self.time is None:
            raise self.attributes.error("time is missing; expected seconds, word:3, word:3.end or end-0.5")
        if self.end is None and self.duration is None and seconds is None:
            raise self.attributes.error("duration is missing; expected duration or end")
        length = self.duration if self.duration is not None else seconds
        return self._checked(self.time, self.end or self.time.after(length or 0.0))

    def to_the_end(self) -> tuple[Anchor, Anchor]:
        """Return start and end of a state that holds throughout unless it says otherwise."""
        start = self.time or Anchor(Base.START, 0.0, place=self.attributes.place)
        rest = Anchor(Base.END, 0.0, place=self.attributes.place)
        end = self.end or (rest if self.duration is None else start.after(self.duration))
        return self._checked(start, end)

    def _checked(self, start: Anchor, end: Anchor) -> tuple[Anchor, Anchor]:
        if start.same_base(end) and not start.seconds < end.seconds:
            message = f"end = {end} is not after time = {start}; expected a later end"
            raise self.attributes.error(message, end.place)
        return start, end


def _common(attributes: Attributes) -> _Common:
    time, duration, end = attributes.anchor("time"), attributes.duration("duration"), attributes.anchor("end")
    if duration is not None and end is not None:
        raise attributes.error("duration and end are both given; expected one of them")
    return _Common(
        attributes,
        _label(attributes),
        time,
        duration,
        end,
        attributes.number("onset", 0.0, MAX_SECONDS),
        attributes.number("offset", 0.0, MAX_SECONDS),
        attributes.number("priority"),
        attributes.number("release_priority"),
        _layer(attributes),
        _function(attributes),
    )


def _label(attributes: Attributes) -> str:
    element = attributes.element
    own = (f'{a.name}="{a.value}"' for a in element.attributes if a.name.lower() not in COMMON)
    return one_line(" ".join((element.name, *own)), _LABEL)


def _layer(attributes: Attributes) -> str:
    attribute = attributes.take("layer")
    return one_line(attribute.value.strip()) if attribute else ""


def _function(attributes: Attributes) -> str | None:
    return attributes.choice("function", ONSET_FUNCTIONS.names())


def _emotion(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    targets, intensities, strongest = take_emotions(attributes, emblem=False)
    if not targets:
        raise attributes.error('no emotion is given; expected e.g. surprise="0.7"')
    mark = common.mark(MarkKind.EMOTION, "emotion", targets, common.to_the_end())
    mark = replace(mark, emotions=intensities)
    if strongest is None:
        return (mark,)
    if mark.priority is None:
        mark = replace(mark, priority=strongest.priority_at(intensities[strongest.name]))
    mark = replace(mark, function=mark.function or strongest.function)
    return (_timed(mark, strongest.onset, strongest.offset),)


def _emblem(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    targets, _, strongest = take_emotions(attributes, emblem=True)
    if strongest is None:
        raise attributes.error('no emotion is given; expected e.g. surprise="0.7"')
    emblem = strongest.emblem
    mark = common.mark(MarkKind.EMBLEM, "emotion", targets, common.lasting(emblem.duration))
    return (_timed(mark, emblem.onset, emblem.offset),)


def _timed(mark: Mark, onset: float, offset: float) -> Mark:
    return replace(
        mark,
        onset=onset if mark.onset is None else mark.onset,
        offset=offset if mark.offset is None else mark.offset,
    )


def _signal(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    table = markup_table()
    targets = take_targets(attributes) or kept_units(table.signal)
    return (common.mark(MarkKind.SIGNAL, "signals", targets, common.lasting(table.duration.signal)),)


def _gaze(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    directions = markup_table().gaze
    target = attributes.choice("target", directions)
    angles = _given(attributes, {"pitch": "gaze_pitch", "yaw": "gaze_yaw"})
    if target and angles:
        raise attributes.error("target and an angle are both given; expected target, or pitch and yaw")
    targets = directions[target].targets if target else angles
    targets |= _given(attributes, {"distance": "gaze_distance"})
    attributes.finish()
    if not targets:
        raise attributes.error('no direction is given; expected target="listener", pitch or yaw')
    return (common.mark(MarkKind.GAZE, "gaze", targets, common.to_the_end()),)


def _given(attributes: Attributes, parameters: Mapping[str, str]) -> dict[str, float]:
    """Return the values of those attributes that are given, by the parameter that each one sets."""
    values: dict[str, float] = {}
    for attribute, name in parameters.items():
        parameter = PARAMETERS[INDEX[name]]
        value = attributes.number(attribute, parameter.low, parameter.high)
        if value is not None:
            values[name] = value
    return values


def _head(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    seconds = markup_table().duration.head
    gesture = take_gesture(attributes)
    pose = _given(attributes, {"pitch": "head_pitch", "yaw": "head_yaw", "roll": "head_roll"})
    tilt = _given(attributes, {"tilt": "head_roll"})
    attributes.finish()
    if "head_roll" in pose and tilt:
        raise attributes.error("tilt and roll are both given; expected one of them")
    pose |= tilt
    if gesture and pose:
        raise attributes.error(f"{gesture.name} and an angle are both given; expected an element for each")
    if gesture:
        mark = common.mark(MarkKind.HEAD, "head", gesture.targets, common.lasting(gesture.seconds))
        return (replace(mark, parts=gesture.parts),)
    if not pose:
        raise attributes.error("nothing is given; expected nod, shake, tilt, pitch, yaw or roll")
    return (common.mark(MarkKind.HEAD, "head", pose, common.lasting(seconds)),)


def _blink(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    intensity = attributes.number("intensity", 0.0, 1.0)
    side = attributes.choice("side", ("both", "left", "right"))
    attributes.finish()
    lids = "orbicularis_oculi_palpebralis" + (f".{side}" if side in ("left", "right") else "")
    targets = kept_units({lids: 1.0 if intensity is None else intensity})
    span = common.lasting(markup_table().duration.blink)
    return (common.mark(MarkKind.BLINK, "manipulators", targets, span),)


def _movement(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    channel = attributes.choice("channel", _MARKED_CHANNELS)
    targets = take_targets(attributes)
    if not targets:
        raise attributes.error('no muscle is given; expected e.g. AU12="0.5" or zygomatic_major="0.5"')
    span = common.lasting()
    return (common.mark(MarkKind.MOVEMENT, channel or _channel_of(targets), targets, span),)


def _channel_of(targets: Mapping[str, float]) -> str:
    """Return the channel of a raw movement: head or eyes alone go to their own."""
    kinds = {PARAMETERS[INDEX[name]].kind for name in in_parameters(targets)}
    if kinds == {Kind.HEAD}:
        return "head"
    return "gaze" if kinds <= {Kind.GAZE, Kind.DISTANCE} else "signals"


def _turn(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    table = markup_table()
    kind = attributes.choice("type", table.turn)
    attributes.finish()
    if kind is None:
        raise attributes.error(f"type is missing; expected {', '.join(table.turn)}")
    return _attitude(common, MarkKind.TURN, table.turn[kind], common.lasting(table.duration.turn))


def _listen(attributes: Attributes) -> tuple[Mark, ...]:
    common = _common(attributes)
    attributes.finish()
    return _attitude(common, MarkKind.LISTEN, markup_table().listen, common.to_the_end())


def _attitude(
    common: _Common, kind: MarkKind, attitude: TurnAttitude, span: tuple[Anchor, Anchor]
) -> tuple[Mark, ...]:
    """Return two marks: the eyes go to the channel of gaze, so that they leave where they looked before."""
    face = common.mark(kind, "regulators", kept_units(attitude.targets), span)
    return face, common.mark(kind, "gaze", attitude.gaze.targets, span)


ELEMENTS: Mapping[str, Callable[[Attributes], tuple[Mark, ...]]] = {
    "EMOTIONDISPLAY": _emotion,
    "EMOTIONEMBLEM": _emblem,
    "SIGNAL": _signal,
    "GAZE": _gaze,
    "HEAD": _head,
    "BLINK": _blink,
    "MOVEMENT": _movement,
    "TURN": _turn,
    "LISTEN": _listen,
}
"""All elements but PHONEME, which is spoken."""


def marks_of(attributes: Attributes) -> tuple[Mark, ...]:
    """Return the marks that an element of `ELEMENTS` asks for; raise InputError, with its place, if bad."""
    try:
        return ELEMENTS[attributes.element.name](attributes)
    except RisoriusError as error:
        raise error.at(attributes.place) from None
