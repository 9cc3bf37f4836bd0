"""All units of a performance, by level."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property

from .rule import Level
from .rule_span import RuleSpan
from .situation import Situation
from .speech_spans import SpeechSpans
from .stillness import StillTime, still_times

# Seconds.
MOMENT = 1.0


class RuleSpans:
    """All units of a situation, by level."""

    def __init__(self, situation: Situation) -> None:
        self.situation = situation
        self._said = situation.utterance
        self._made: dict[Level, tuple[RuleSpan, ...]] = {}

    def of(self, level: Level) -> tuple[RuleSpan, ...]:
        """Return the units of a level in order; none of those that speech has if nothing is said."""
        silent = self._said is None or not self._said.words
        if silent and level is not Level.MOMENT:
            return ()
        if level not in self._made:
            make = self._moments if level is Level.MOMENT else self._spoken[level]
            self._made[level] = tuple(make())
        return self._made[level]

    @cached_property
    def boundaries(self) -> tuple[float, ...]:
        """Return where phonemes begin and end, seconds, in order."""
        if self._said is None:
            return ()
        return (0.0, *(phone.end for phone in self._said.phones))

    @cached_property
    def pauses(self) -> tuple[StillTime, ...]:
        """Return the pauses, in which the head stands still, in order."""
        return still_times(self._said) if self._said is not None else ()

    @cached_property
    def _spoken(self) -> dict[Level, Callable[[], Iterator[RuleSpan]]]:
        """The function that makes the units of each level of speech."""
        assert self._said is not None
        spoken = SpeechSpans(self._said, self.situation)
        return {
            Level.PHONEME: spoken.phonemes,
            Level.SYLLABLE: spoken.syllables,
            Level.WORD: spoken.words,
            Level.ITEM: spoken.items,
            Level.PHRASE: lambda: spoken.stretches(Level.PHRASE),
            Level.UTTERANCE: lambda: spoken.stretches(Level.UTTERANCE),
            Level.TURN: lambda: spoken.stretches(Level.TURN),
            Level.PAUSE: spoken.pauses,
            Level.INFORMATION: spoken.information,
        }

    def _moments(self) -> Iterator[RuleSpan]:
        s = self.situation
        for index in range(int(s.duration / MOMENT)):
            start = index * MOMENT
            middle = start + 0.5 * MOMENT
            yield RuleSpan(
                Level.MOMENT, 0, index, start, start + MOMENT, f"{start:g} s",
                emotions=s.emotions_at(middle), turn=s.turn_at(middle),
            )  # fmt: skip
