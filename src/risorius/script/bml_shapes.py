"""BML's behaviours: their attributes, and the sync points that each has by itself.

Reader and writer share its words: what reads scripts (`bml`), and the feedback that is written from a plan.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ..core.channels import channel_timing
from ..core.parameters import INDEX, PARAMETERS
from ..rules.bml import bml_table
from ..rules.gestures import GesturePart, gesture_parts, gesture_seconds
from ..rules.markup import markup_table
from .gestures import MOST_REPETITIONS
from .tree import XmlNode

NAMESPACE = "http://www.bml-initiative.org/bml/bml-1.0"
PEAKS: Mapping[str, str] = MappingProxyType({"face": "attackPeak", "gaze": "ready", "head": "stroke"})
"""The sync point at which each kind of behaviour is fully there (BML 1.0, sync points)."""
USUAL_AMOUNT = 0.5
SHIFT_SECONDS = 0.4
_HEAD_POINTS = ("start", "ready", "strokeStart", "stroke", "strokeEnd", "relax", "end")
# Attributes of all behaviours beside their sync points, and those of each.
ANY = ("id",)
_DIRECTED = ("target", "influence", "offsetAngle", "offsetDirection")
ATTRIBUTES: Mapping[str, tuple[str, ...]] = {
    "faceLexeme": ("lexeme", "amount"),
    "faceFacs": ("au", "side", "amount"),
    "faceShift": ("lexeme", "au", "side", "amount"),
    "gaze": _DIRECTED,
    "gazeShift": _DIRECTED,
    "head": ("lexeme", "repetition", "amount"),
    "headDirectionShift": _DIRECTED,
}


def limited(values: Mapping[str, float]) -> dict[str, float]:
    """Return the values of parameters, each within its range."""
    parameters = {name: PARAMETERS[INDEX[name]] for name in values}
    return {
        name: min(max(value, parameters[name].low), parameters[name].high) for name, value in values.items()
    }


def gesture_of(node: XmlNode) -> tuple[tuple[GesturePart, ...], dict[str, float], float]:
    """Return the parts, targets and seconds of a head's lexeme."""
    gestures = markup_table().head
    node.required("lexeme", 'lexeme="NOD"')
    gesture = gestures[node.choice("lexeme", tuple(gestures), "nod")]
    times = int(node.number("repetition", 1, MOST_REPETITIONS, 1))
    size = gesture.amplitude * node.number("amount", 0.0, 1.0, USUAL_AMOUNT) / USUAL_AMOUNT
    parts = gesture_parts(gesture, times)
    return parts, limited({gesture.parameter: size}), gesture_seconds(gesture, parts)


def _face_shape(node: XmlNode) -> Mapping[str, float]:
    timing, length = channel_timing("signals"), bml_table().duration.face
    return {"start": 0.0, PEAKS["face"]: timing.onset, "relax": length - timing.offset, "end": length}


def _gaze_shape(node: XmlNode) -> Mapping[str, float]:
    timing, length = channel_timing("gaze"), bml_table().duration.gaze
    return {"start": 0.0, PEAKS["gaze"]: timing.onset, "relax": length - timing.offset, "end": length}


def _shift_shape(node: XmlNode) -> Mapping[str, float]:
    return {"start": 0.0, "end": SHIFT_SECONDS}


def _head_shape(node: XmlNode) -> Mapping[str, float]:
    _, _, seconds = gesture_of(node)
    # Ready at the start; the parts lie in the middle, and the last swing leads back to rest.
    shares = (0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0)
    return {point: share * seconds for point, share in zip(_HEAD_POINTS, shares, strict=True)}


SHAPES: Mapping[str, Callable[[XmlNode], Mapping[str, float]]] = {
    "faceLexeme": _face_shape,
    "faceFacs": _face_shape,
    "faceShift": _shift_shape,
    "gaze": _gaze_shape,
    "gazeShift": _shift_shape,
    "head": _head_shape,
    "headDirectionShift": _shift_shape,
}
"""The sync points of each behaviour in seconds after its start."""
