"""From marks to movements, once the words' times are known."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ..core.action_units import in_parameters
from ..core.antagonists import antagonist_pairs
from ..core.channels import ChannelTiming, channel_timing
from ..core.movement import Cause, Movement
from ..core.speech.utterance import Word
from ..core.time import on_tick
from ..errors import InputError, warn
from ..rules.gestures import GesturePart
from ..rules.saccade import saccade_duration
from .apart import check_apart
from .model import Mark, Script

_GAZE = ("gaze_pitch", "gaze_yaw")


@dataclass(frozen=True, slots=True)
class _Timed:
    """A mark, or a part of one, with its span in seconds."""

    mark: Mark
    part: GesturePart
    number: int
    start: float
    end: float
    length: float

    @property
    def targets(self) -> dict[str, float]:
        return {name: self.part.scale * value for name, value in self.mark.targets.items()}


def movements_of(script: Script, words: Sequence[Word], duration: float) -> tuple[Movement, ...]:
    """Return the script's marks as movements, in order of time, channel and layer.

    `words` are those of the utterance, with their times; `duration` is the performance's, in seconds. Raises
    InputError, with the place, for a word that does not exist, for an end before its start, and for two
    marks that start together in one layer of a channel.
    """
    timed = [part for mark in script.marks for part in _parts(mark, words, duration)]
    for mark in script.marks:
        _warn_of_rivals(mark)
    timed.sort(key=lambda t: (t.start, t.mark.channel, t.mark.layer, t.end, t.mark.label))
    check_apart((t.mark, t.start) for t in timed)
    eyes = _Eyes()
    return tuple(_movement(t, eyes) for t in timed)


def _warn_of_rivals(mark: Mark) -> None:
    """Warn of the conflicting targets that a mark names; those of emotions are blended by their tables."""
    messages: set[str] = set()
    for larger, smaller in antagonist_pairs({} if mark.emotions else in_parameters(mark.targets)):
        names = [name.partition(".")[0] for name in (smaller, larger)]
        left = max(1.0 - in_parameters(mark.targets)[larger], 0.0)
        messages.add(
            f"{mark.place}: {mark.label}: {names[0]} conflicts with {names[1]}; it is held to {left:g}"
        )
    for message in sorted(messages):
        warn(message)


def _parts(mark: Mark, words: Sequence[Word], duration: float) -> Iterator[_Timed]:
    start, end = (on_tick(a.resolve(words, duration)) for a in (mark.start, mark.end))
    end = on_tick(max(end, min(end + mark.fading, duration)))
    if not start < end:
        raise InputError(
            f"{mark.label} ends at {end:g} s ({mark.end}), not after its start at {start:g} s ({mark.start})",
            mark.place,
        )
    length = end - start
    for number, part in enumerate(mark.parts, 1):
        begin, stop = (on_tick(start + share * length) for share in (part.start, part.end))
        yield _Timed(mark, part, number, begin, stop, length)


def _movement(timed: _Timed, eyes: _Eyes) -> Movement:
    mark = timed.mark
    timing = channel_timing(mark.channel)
    onset, offset = _default_timing(timed, timing, eyes)
    return Movement(
        mark.channel,
        timed.start,
        timed.end,
        onset if mark.onset is None else mark.onset,
        offset if mark.offset is None else mark.offset,
        timed.targets,
        id=_id(timed),
        layer=mark.layer,
        priority=mark.priority,
        release_priority=mark.release_priority,
        function=mark.function or _function(mark, timing),
        cause=Cause("script", mark.label, str(mark.place)),
    )


def _id(timed: _Timed) -> str:
    mark = timed.mark
    where = ".".join(str(n) for n in (mark.place.line, mark.place.column) if n is not None)
    name = f"{mark.channel}@{where}"
    return name if len(mark.parts) == 1 else f"{name}.{timed.number}"


def _function(mark: Mark, timing: ChannelTiming) -> str:
    return channel_timing("gaze").function if _moves_eyes_alone(mark) else timing.function


def _default_timing(timed: _Timed, timing: ChannelTiming, eyes: _Eyes) -> tuple[float, float]:
    """Return seconds of onset and offset: by the eyes' angle, the part's length, or the channel."""
    if _moves_eyes_alone(timed.mark):
        return eyes.turn(timed)
    part = timed.part
    onset = timing.onset if part.onset is None else part.onset * timed.length
    offset = timing.offset if part.offset is None else part.offset * timed.length
    return onset, offset


def _moves_eyes_alone(mark: Mark) -> bool:
    return bool(mark.targets) and all(name in _GAZE for name in mark.targets)


class _Eyes:
    """The eyes' direction after each layer's last movement, so that a turn takes the time its angle needs."""

    def __init__(self) -> None:
        self._last: dict[tuple[str, str], tuple[float, tuple[float, float]]] = {}

    def turn(self, timed: _Timed) -> tuple[float, float]:
        """Return the seconds that the eyes take to the movement's direction, and from there back to rest."""
        key = (timed.mark.channel, timed.mark.layer)
        end, direction = self._last.get(key, (-math.inf, (0.0, 0.0)))
        origin = direction if end >= timed.start else (0.0, 0.0)
        targets = timed.targets
        goal = (targets.get(_GAZE[0], 0.0), targets.get(_GAZE[1], 0.0))
        self._last[key] = (timed.end, goal)
        return saccade_duration(math.dist(origin, goal)), saccade_duration(math.hypot(*goal))
