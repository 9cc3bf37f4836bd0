"""Marks of emotions that scripts name."""

from __future__ import annotations

from ..errors import ParameterError, Place
from ..rules.emotions import emotion as find_emotion
from .anchor import Anchor
from .model import Mark, MarkKind


def display_mark(
    name: str,
    intensity: float,
    span: tuple[Anchor, Anchor],
    place: Place,
    priority: float | None = None,
    layer: str = "",
    *,
    fades: bool = False,
) -> Mark:
    """Return the display of an emotion, by name, over a span; without a layer, in that of its name.

    `fades`: it falls after the span, else at the end of it.

    Raises ParameterError, with the place, for an unknown name and an intensity outside 0..1.
    """
    try:
        emotion = find_emotion(name)
        targets = emotion.shown_units(intensity)
    except ParameterError as error:
        raise error.at(place) from None
    return Mark(
        MarkKind.EMOTION, "emotion", *span, targets, f"emotion: {emotion.name} {intensity:g}", place,
        emotion.onset, emotion.offset,
        layer=layer or emotion.name, emotions={emotion.name: intensity}, function=emotion.function,
        priority=emotion.priority_at(intensity) if priority is None else priority,
        fading=emotion.offset if fades else 0.0,
    )  # fmt: skip
