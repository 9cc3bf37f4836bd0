"""Nods and shakes: one mark that consists of several parts."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.parameters import INDEX, PARAMETERS
from ..rules.gestures import GesturePart, gesture_parts, gesture_seconds
from ..rules.markup import Gesture, markup_table
from .attributes import Attributes

MOST_REPETITIONS = 10


@dataclass(frozen=True, slots=True)
class TakenGesture:
    """A gesture as an element asks for it: its parts, and how many seconds it lasts by default."""

    name: str
    targets: dict[str, float]
    parts: tuple[GesturePart, ...]
    seconds: float


def take_gesture(attributes: Attributes) -> TakenGesture | None:
    """Return the nod or shake that an element asks for, None if it asks for none.

    The value is how many times, 1 to 10, or, below 1, how strong a single one is; `amplitude` gives its size
    in degrees. Raises InputError, with the place, for other values and for both gestures together.
    """
    gestures = markup_table().head
    values = {name: attributes.number(name, 0.0, MOST_REPETITIONS) for name in gestures}
    chosen = {name: value for name, value in values.items() if value is not None}
    amplitude = attributes.number("amplitude", 0.0, 45.0)
    if len(chosen) > 1:
        raise attributes.error(f"{' and '.join(chosen)} are both given; expected an element for each")
    if not chosen:
        if amplitude is not None:
            raise attributes.error("amplitude is given without nod or shake; expected one of them")
        return None
    name, value = next(iter(chosen.items()))
    if value > 1.0 and not value.is_integer():
        raise attributes.error(
            f"{name} = {value:g} is not a number of times; expected 1, 2, 3 … or less than 1"
        )
    return _taken(name, gestures[name], value, amplitude)


def _taken(name: str, gesture: Gesture, value: float, amplitude: float | None) -> TakenGesture:
    degrees = (gesture.amplitude if amplitude is None else amplitude) * min(value, 1.0)
    parameter = PARAMETERS[INDEX[gesture.parameter]]
    times = max(1, int(value))
    parts = gesture_parts(gesture, times)
    targets = {gesture.parameter: min(degrees, parameter.high)}
    return TakenGesture(name, targets, parts, gesture_seconds(gesture, parts))
