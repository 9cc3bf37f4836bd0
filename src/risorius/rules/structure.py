"""How what is said is divided: phrases, utterances and turns, with their questions, groups and rates."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..core.utterance import Pause, PauseKind, Question, Utterance
from .rule import Level
from .synchrony import synchrony

SENTENCE_ENDS = (PauseKind.FULL_STOP, PauseKind.QUESTION, PauseKind.EXCLAMATION, PauseKind.FINAL)
# Words of a stretch that messages show.
_SHOWN = 8


@dataclass(frozen=True, slots=True)
class Stretch:
    """Words [first, last) of a phrase, an utterance or a turn, seconds, and the pause after it."""

    first: int
    last: int
    start: float
    end: float
    pause: Pause | None


class Structure:
    """The divisions of what is said; there is at least one word. `listening`: spans in which turns end."""

    def __init__(self, said: Utterance, listening: Sequence[tuple[float, float]]) -> None:
        self.said, self._listening = said, listening
        self.boundary_of = {boundary.word: boundary.label for boundary in said.boundaries}
        self.stretches = {
            Level.PHRASE: [self._stretch(p.first_word, p.last_word) for p in said.phrases],
            Level.UTTERANCE: [self._stretch(s.first_word, s.last_word) for s in said.sentences],
            Level.TURN: self._turns(),
        }
        self._questions = [sentence.question for sentence in said.sentences]
        self._groups = list(self._grouped())
        self._rates = [self._rate(p) for p in self.stretches[Level.PHRASE]]

    def after(self, word: int) -> Pause | None:
        """Return the pause after a word, by its index, None where there is none."""
        return self.said.pause_after(word)

    def index(self, level: Level, word: int) -> int:
        """Return which phrase, utterance or turn holds a word."""
        return bisect_right(self.stretches[level], word, key=lambda s: s.first) - 1

    def question(self, word: int) -> Question:
        """Return how the utterance of a word asks."""
        return self._questions[self.index(Level.UTTERANCE, word)]

    def group(self, word: int) -> int:
        """Return the run of related utterances that a word belongs to."""
        return self._groups[self.index(Level.UTTERANCE, word)]

    def rate(self, word: int) -> float:
        """Return the syllables a second of a word's phrase."""
        return self._rates[self.index(Level.PHRASE, word)]

    def text(self, stretch: Stretch) -> str:
        """Return the first words of a stretch, to name it by."""
        words = [w.text for w in self.said.words[stretch.first : stretch.last]]
        return " ".join(words[:_SHOWN]) + (" …" if len(words) > _SHOWN else "")

    def _ends_turn(self, word: int) -> bool:
        if word + 1 == len(self.said.words):
            return True
        end, begin = self.said.words[word].end, self.said.words[word + 1].start
        return any(start < begin and end < stop for start, stop in self._listening)

    def _turns(self) -> list[Stretch]:
        edges = [0, *(i + 1 for i in range(len(self.said.words)) if self._ends_turn(i))]
        return [self._stretch(a, b) for a, b in pairwise(edges)]

    def _stretch(self, first: int, last: int) -> Stretch:
        words = self.said.words
        return Stretch(first, last, words[first].start, words[last - 1].end, self.after(last - 1))

    def _grouped(self) -> Iterator[int]:
        """Yield the group of each utterance: a long silence or a new line begins another subject."""
        group = 0
        yield group
        for before, after in pairwise(self.stretches[Level.UTTERANCE]):
            words = self.said.words
            between = self.said.text[words[before.last - 1].source_end : words[after.first].source_start]
            group += "\n" in between or after.start - before.end > synchrony().group_pause
            yield group

    def _rate(self, phrase: Stretch) -> float:
        first = bisect_left(self.said.syllables, phrase.first, key=lambda s: s.word)
        last = bisect_left(self.said.syllables, phrase.last, key=lambda s: s.word)
        return (last - first) / (phrase.end - phrase.start) if last > first else synchrony().usual_rate
