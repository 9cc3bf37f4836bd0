"""The acts of APML and FML-APML: each has a span and becomes marks."""

from __future__ import annotations

from collections.abc import Iterator

from ..core.action_units import kept_units
from ..core.channels import channel_timing
from ..errors import ParameterError, unknown
from ..rules.apml import Act, apml_table
from ..rules.emotions import emotion_names
from ..rules.gestures import gesture_parts, gesture_seconds
from ..rules.markup import markup_table
from .anchor import Anchor
from .displays import display_mark
from .elements import Attribute
from .model import Mark, MarkKind
from .quote import one_line
from .tree import Unknowns, XmlNode

Span = tuple[Anchor, Anchor]
TURN_ELEMENTS = ("turn-allocation", "turnallocation", "turntaking")
REGULATIONS = ("felt", "fake", "inhibit", "inhibited")


def marks_of_act(node: XmlNode, name: str, span: Span, layer: str, unknowns: Unknowns) -> Iterator[Mark]:
    """Yield the marks of an act `name`, a performative, a certainty or a backchannel, over its span."""
    kind = node.get("type")
    if kind is None:
        unknowns.tell(f"<{node.written}> without type", node.place, "nothing is shown for it")
        return
    acts = apml_table().act[name]
    written = kind.value.strip()
    if written.lower() not in acts:
        message = unknown(name, one_line(written), acts)
        unknowns.misunderstood(message, kind.place, "nothing is shown for it")
        return
    level = node.number("intensity", 0.0, 1.0, apml_table().usual.intensity)
    label = one_line(f"{name} {written}")
    yield from _shown(acts[written.lower()], level, label, node, span, layer)


def _shown(act: Act, level: float, label: str, node: XmlNode, span: Span, layer: str) -> Iterator[Mark]:
    if act.targets and level > 0.0:
        targets = kept_units({unit: level * value for unit, value in act.targets.items()})
        fading = channel_timing("emotion").offset
        yield Mark(
            MarkKind.SIGNAL, "emotion", *span, targets, label, node.place, layer=layer, fading=fading
        )  # fmt: skip
    if act.gesture is not None and level > 0.0:
        gesture = markup_table().head[act.gesture]
        parts = gesture_parts(gesture, 1)
        start, targets = span[0], {gesture.parameter: level * gesture.amplitude}
        end = start.after(gesture_seconds(gesture, parts))
        yield Mark(MarkKind.HEAD, "head", start, end, targets, label, node.place, layer=layer, parts=parts)


def marks_of_turn(node: XmlNode, span: Span) -> Iterator[Mark]:
    """Yield the marks of a turn that is taken, kept or given: the last at the end of its span."""
    turns = apml_table().turn
    node.required("type", 'type="take"')
    turn = turns[node.choice("type", tuple(turns), "")]
    seconds = markup_table().duration.turn
    first, last = span
    placed = (last.after(-seconds), last) if turn == "give" else (first, first.after(seconds))
    attitude = markup_table().turn[turn]
    label = f"turn {turn}"
    yield Mark(
        MarkKind.TURN, "regulators", *placed, kept_units(attitude.targets), label, node.place, layer=label
    )
    yield Mark(MarkKind.TURN, "gaze", *placed, attitude.gaze.targets, label, node.place, layer=label)


def marks_of_affect(affect: Attribute, node: XmlNode, span: Span, layer: str = "") -> Iterator[Mark]:
    """Yield the display of an affect, by our name of an emotion or by that of APML; of neutral, nothing.

    Raises ParameterError, with its place, for an unknown one.
    """
    name = affect.value.strip()
    level = node.number("intensity", 0.0, 1.0, apml_table().usual.intensity)
    if name.lower() == "neutral" or level == 0.0:
        return
    affects = {key.lower(): value for key, value in apml_table().affect.items()}
    if name.lower() in affects:
        equal = affects[name.lower()]
        yield display_mark(equal.emotion, equal.share * level, span, affect.place, layer=layer, fades=True)
        return
    if name.lower() not in emotion_names():
        known = (*apml_table().affect, *emotion_names())
        raise ParameterError(unknown("affect", one_line(name), known), affect.place)
    yield display_mark(name, level, span, affect.place, layer=layer, fades=True)


def marks_of_emotion(node: XmlNode, span: Span, layer: str, unknowns: Unknowns) -> Iterator[Mark]:
    """Yield the display of an emotion of FML-APML; one that is inhibited is not shown."""
    regulation = node.choice("regulation", REGULATIONS, "felt")
    attribute = node.get("regulation")
    if attribute is not None and regulation != "felt":
        hidden = regulation.startswith("inhibit")
        instead = "the emotion is not shown" if hidden else "the emotion is shown as felt"
        unknowns.tell(f"regulation '{regulation}'", attribute.place, instead)
        if hidden:
            return
    yield from marks_of_affect(node.required("type", 'type="joy"'), node, span, layer)
