"""The situation that rules are matched against: words, emotions, and spans of listening."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..core.speech.utterance import Utterance
from .emotions import Display, emotion_key
from .rule import InformationPart, TurnState


@dataclass(frozen=True, slots=True)
class PartSpan:
    """A theme or a rheme in seconds [start, end)."""

    part: InformationPart
    start: float
    end: float


@dataclass(frozen=True, slots=True)
class Situation:
    """`felt`: emotions with their spans. `listening`: spans of listening in order, seconds. `information`:
    themes and rhemes, in order.
    """

    duration: float
    utterance: Utterance | None = None
    felt: tuple[Display, ...] = ()
    listening: tuple[tuple[float, float], ...] = ()
    information: tuple[PartSpan, ...] = ()

    def emotions_at(self, time: float) -> Mapping[str, float]:
        """Return the emotions felt at a time, by name, with their intensities 0..1."""
        found: dict[str, float] = {}
        for display in self.felt:
            start = 0.0 if display.start is None else display.start
            end = self.duration if display.end is None else display.end
            if start <= time <= end:
                name = emotion_key(display.emotion)
                found[name] = max(found.get(name, 0.0), display.intensity)
        return found

    def turn_at(self, time: float) -> TurnState:
        """Return whose turn it is at a time."""
        for start, end in self.listening:
            if start <= time < end:
                return TurnState.LISTENING
        return TurnState.SPEAKING
