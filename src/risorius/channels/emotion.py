"""Emotion: displays marked and asked for, emblems by rules, and a slight posture that is always shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from ..core.action_units import check_intensity
from ..core.channels import POSTURE_LAYER, channel_timing
from ..core.movement import Cause, Movement
from ..core.parameters import INDEX, PARAMETERS, Kind
from ..errors import InputError
from ..rules.emotions import Display, emotion_key
from ..rules.emotions import emotion as find_emotion
from ..rules.fuzzy import shown_units
from .head import posture
from .inputs import ChannelInputs, Context
from .registry import register
from .ruled import marked_and_ruled

POSTURE = "emotion.posture.speaker"
_OVERLAP = 0.05
# Seconds after the clip's end until displays that last to the end are released: later than any frame.
_BEYOND = 0.1


def emotion(inputs: ChannelInputs, context: Context) -> Iterator[Movement]:
    """Yield the marked displays, then the others, each in a layer of its own so that they blend."""
    yield from marked_and_ruled(inputs, context)
    if inputs.lively:
        yield from _posture(inputs)
    displays = [_placed(display, inputs.duration) for display in inputs.emotions]
    for number, display in enumerate(displays, 1):
        yield from _movements(display, number, displays, inputs.duration)


def _posture(inputs: ChannelInputs) -> Iterator[Movement]:
    face = {n: v for n, v in posture(inputs).items() if PARAMETERS[INDEX[n]].kind is Kind.MUSCLE and v > 0.0}
    if face:
        yield Movement(
            "emotion", 0.0, inputs.duration, 0.0, 0.0, face,
            id=POSTURE, layer=POSTURE_LAYER, function=channel_timing("emotion").function,
            cause=Cause(POSTURE, inputs.profile.name),
        )  # fmt: skip


def _placed(display: Display, duration: float) -> Display:
    emotion = find_emotion(display.emotion)
    start = 0.0 if display.start is None else display.start
    end = duration if display.end is None else display.end
    if not 0.0 <= start < end:
        raise InputError(
            f"emotion {emotion.name}: from {start:g} to {end:g} s is not a span; expected 0 <= start < end"
        )
    intensity = check_intensity(emotion.name, display.intensity)
    priority = emotion.priority_at(intensity) if display.priority is None else display.priority
    return Display(emotion_key(display.emotion), intensity, start, end, priority)


def _movements(
    display: Display, number: int, displays: Sequence[Display], duration: float
) -> Iterator[Movement]:
    """Yield a display, in parts if others begin or end beside it: in company it may show less.

    One that lasts as long as the clip is not released in it: the last pause is stillness.
    """
    emotion = find_emotion(display.emotion)
    first, last = float(display.start or 0.0), float(display.end or 0.0)
    after = emotion.offset + _BEYOND if display.end == duration else 0.0
    edges = {t for d in displays for t in (d.start, d.end) if t is not None and first < t < last}
    for start, end, targets in _parts(display.emotion, [first, *sorted(edges), last], displays):
        yield Movement(
            "emotion",
            start,
            end + after if end == last else end + _OVERLAP,
            emotion.onset,
            emotion.offset if end == last else _OVERLAP,
            targets,
            id=f"emotion.{number}.{emotion.name}" + (f"@{start:.3f}" if start > first else ""),
            layer=f"{number}.{emotion.name}",
            priority=display.priority,
            function=emotion.function,
            cause=Cause("emotion.display", f"{emotion.name} {display.intensity:g}", "option"),
        )


def _parts(
    name: str, times: Sequence[float], displays: Sequence[Display]
) -> Iterator[tuple[float, float, dict[str, float]]]:
    """Yield start, end and targets of a display's parts between the times, alike neighbours as one."""
    shown = [shown_units(name, _company(displays, 0.5 * (a + b))) for a, b in pairwise(times)]
    start = times[0]
    for number, targets in enumerate(shown, 1):
        if number == len(shown) or shown[number] != targets:
            yield start, times[number], targets
            start = times[number]


def _company(displays: Sequence[Display], time: float) -> Mapping[str, float]:
    """Return the emotions displayed at a time with their intensities."""
    intensities: dict[str, float] = {}
    for d in displays:
        if d.start is not None and d.end is not None and d.start <= time < d.end:
            intensities[d.emotion] = max(intensities.get(d.emotion, 0.0), d.intensity)
    return intensities


# The rise and fall of what is felt: facts: science/05, section 5.5.
register("emotion", 10.0, emotion, timing=(0.45, 0.75, "minimum_jerk"), rules=True, marks=True)
