"""Emotion: the displays that the script marks and those asked for beside it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core.movement import Cause, Movement
from ..errors import InputError
from ..rules.emotions import Display
from ..rules.emotions import emotion as find_emotion
from .registry import CHANNEL_BUILDERS, Brief


@CHANNEL_BUILDERS.register("emotion")
def emotion(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
    """Yield the marked displays, then the others, each in a layer of its own so that they blend."""
    yield from (m for m in brief.marks if m.channel == "emotion")
    for number, display in enumerate(brief.emotions, 1):
        yield _movement(display, number, brief.duration)


def _movement(display: Display, number: int, duration: float) -> Movement:
    found = find_emotion(display.emotion)
    start = 0.0 if display.start is None else display.start
    end = duration if display.end is None else display.end
    if not 0.0 <= start < end:
        raise InputError(
            f"emotion {found.name}: from {start:g} to {end:g} s is not a span; expected 0 <= start < end"
        )
    return Movement(
        "emotion",
        start,
        end,
        found.onset,
        found.offset,
        found.targets(display.intensity),
        id=f"emotion.{number}.{found.name}",
        layer=f"{number}.{found.name}",
        cause=Cause("emotion.display", f"{found.name} {display.intensity:g}", "option"),
    )
