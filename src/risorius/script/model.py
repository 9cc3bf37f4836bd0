"""The script: lines to be said and marks to be shown, before anything is spoken."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

from ..core.directions import UNDIRECTED, Directions
from ..core.speech.utterance import Word
from ..errors import Place
from ..rules.gestures import GesturePart
from ..rules.rule import InformationPart
from .anchor import Anchor, Base

# Minimum hold, in seconds, of a mark that lasts to the end and has no onset of its own.
SHORTEST_HOLD = 0.3


class MarkKind(StrEnum):
    """The kind of movement that a mark asks for."""

    EMOTION = "emotion"
    EMBLEM = "emblem"
    SIGNAL = "signal"
    GAZE = "gaze"
    HEAD = "head"
    BLINK = "blink"
    MOVEMENT = "movement"
    TURN = "turn"
    LISTEN = "listen"


WHOLE = (GesturePart(),)


@dataclass(frozen=True, slots=True)
class Mark:
    """Something to show on one channel.

    `targets` maps parameter names to values. `onset`, `offset` in seconds and `function` are None if the
    channel's own apply, `priority` and `release_priority` likewise. `parts`: the movements that the mark
    consists of, one for all but gestures of the head. `label`: how the user wrote it. `emotions`: those felt,
    by name, with their intensities 0..1. `fading`: for how many seconds it still falls after its end, unless
    the performance is over.
    """

    kind: MarkKind
    channel: str
    start: Anchor
    end: Anchor
    targets: Mapping[str, float]
    label: str
    place: Place
    onset: float | None = None
    offset: float | None = None
    priority: float | None = None
    release_priority: float | None = None
    layer: str = ""
    function: str | None = None
    parts: tuple[GesturePart, ...] = WHOLE
    emotions: Mapping[str, float] = field(default_factory=dict)
    fading: float = 0.0


@dataclass(frozen=True, slots=True)
class SpokenLine:
    """Words spoken in one go, from `start` seconds on; if it is None, `gap` seconds after the line before.

    `source_offset`: where the line begins in the script's text. `place`: where it stands in the source.
    `directions` count the line's own characters. `gap` None is the usual gap.
    """

    text: str
    start: float | None
    place: Place
    source_offset: int = 0
    directions: Directions = UNDIRECTED
    gap: float | None = None


@dataclass(frozen=True, slots=True)
class PartMark:
    """A theme or a rheme, from `start` to `end`."""

    part: InformationPart
    start: Anchor
    end: Anchor
    place: Place


@dataclass(frozen=True, slots=True)
class Script:
    """The words to speak, line by line, and the marks.

    `text`: all lines, joined by line ends. `timed`: times are absolute, without lead or tail (markup).
    `source`: the file's name. `language`: None if the source does not say. `duration`: how many seconds the
    performance lasts at least. `information`: what is theme and what is rheme.
    """

    text: str
    lines: tuple[SpokenLine, ...]
    marks: tuple[Mark, ...] = ()
    timed: bool = False
    source: str = "text"
    language: str | None = None
    duration: float = 0.0
    information: tuple[PartMark, ...] = ()

    def lasting(self, words: Sequence[Word], spoken: float) -> float:
        """Return how many seconds the performance lasts at least; `words` fill `spoken` seconds.

        A mark that holds to the end has time to appear. Raises InputError for a word that does not exist.
        """
        moments = [spoken, self.duration]
        for mark in self.marks:
            for anchor, more in ((mark.start, mark.onset or SHORTEST_HOLD), (mark.end, 0.0)):
                if anchor.base is not Base.END:
                    moments.append(anchor.resolve(words, spoken) + more)
        return max(moments)


def script_of(
    lines: tuple[SpokenLine, ...],
    marks: tuple[Mark, ...] = (),
    *,
    timed: bool,
    source: str,
    language: str | None = None,
) -> Script:
    """Return the script of these lines, their offsets set to where they stand in its text."""
    placed: list[SpokenLine] = []
    offset = 0
    for line in lines:
        placed.append(replace(line, source_offset=offset))
        offset += len(line.text) + len(LINE_END)
    text = LINE_END.join(line.text for line in lines)
    return Script(text, tuple(placed), marks, timed, source, language)


LINE_END = "\n"
