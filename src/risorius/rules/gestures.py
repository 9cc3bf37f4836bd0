"""Nods and shakes of the head: gestures of several parts that follow one another."""

from __future__ import annotations

from dataclasses import dataclass

from .markup import Gesture


@dataclass(frozen=True, slots=True)
class GesturePart:
    """One movement of a gesture: span, onset and offset as shares of the gesture's, and the targets' scale.

    `onset` and `offset` are None if they do not depend on the gesture's length.
    """

    start: float = 0.0
    end: float = 1.0
    scale: float = 1.0
    onset: float | None = None
    offset: float | None = None


def gesture_parts(gesture: Gesture, times: int) -> tuple[GesturePart, ...]:
    """Return the parts of a gesture made `times` times.

    Each part spans two swings, one out and one back, and the next begins when it is fully out: the head
    goes from peak to peak, and after the last back to rest.
    """
    scales = [swing * gesture.decay**time for time in range(times) for swing in gesture.swings]
    unit = 1.0 / (len(scales) + 1)
    return tuple(GesturePart(i * unit, (i + 2) * unit, scale, unit, unit) for i, scale in enumerate(scales))


def gesture_seconds(gesture: Gesture, parts: tuple[GesturePart, ...]) -> float:
    """Return how long a gesture of these parts lasts by default, seconds."""
    return gesture.seconds * (len(parts) + 1)
