"""Nods and shakes of the head: gestures of several parts that follow one another."""

from __future__ import annotations

from dataclasses import dataclass

from .markup import Gesture

LEAST_OF_GESTURE = 0.6
"""The least share of its usual time in which a gesture is made."""


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


@dataclass(frozen=True, slots=True)
class TimedPart:
    """A part of a gesture in seconds from the gesture's start, and the targets' scale."""

    start: float
    end: float
    onset: float
    offset: float
    scale: float


def timed_parts(
    gesture: Gesture, times: int, room: float, rest: float = 0.0, then: float = 0.0
) -> list[TimedPart]:
    """Return the parts of a gesture that begins `room` seconds before a pause.

    It is made fewer times if there is no time for all, and hurried to `LEAST_OF_GESTURE` of its time at most.
    If that is not enough, it is held through the pause, `rest` seconds, when fully out, and goes on after it,
    if it can in the `then` seconds to the next pause. If `then` is 0, nothing is said any more, and the
    gesture goes on in the pause.
    """
    while times > 1 and LEAST_OF_GESTURE * gesture_seconds(gesture, gesture_parts(gesture, times)) > room:
        times -= 1
    parts = gesture_parts(gesture, times)
    usual = gesture_seconds(gesture, parts)
    fits = LEAST_OF_GESTURE * usual <= room
    if fits or then == 0.0:
        swing = min(1.0, max(room / usual, LEAST_OF_GESTURE)) * gesture.seconds
        return [TimedPart(i * swing, (i + 2) * swing, swing, swing, p.scale) for i, p in enumerate(parts)]
    swing = min(gesture.seconds, max(room, LEAST_OF_GESTURE * gesture.seconds))
    held = min(max(int(room / swing), 1), len(parts))  # the swing at whose end the pause comes
    again, left = room + rest, len(parts) - held
    quick = min(swing, max(then / (left + 1), LEAST_OF_GESTURE * swing))
    tops = [swing * (i + 1) if i < held else again + quick * (i - held + 1) for i in range(len(parts))]
    starts = [0.0, *tops[: held - 1], *([again] if left else ()), *tops[held:-1]]
    ends = [*tops[1:held], again + quick, *(top + quick for top in tops[held:])]
    return [
        TimedPart(start, end, top - start, quick if i >= held - 1 else swing, part.scale)
        for i, (start, end, top, part) in enumerate(zip(starts, ends, tops, parts, strict=True))
    ]
