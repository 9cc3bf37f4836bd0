"""How what is said is divided: phrases, utterances and turns, with their questions, groups and rates."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..core.utterance import Pause, PauseKind, Utterance
from .intonation import intonation_table
from .rule import Level, Question
from .synchrony import synchrony

SENTENCE_ENDS = (PauseKind.FULL_STOP, PauseKind.QUESTION, PauseKind.EXCLAMATION, PauseKind.FINAL)
# Digits of a second within which a pause begins where a word ends.
_DIGITS = 6
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
        self._pause_at = {round(pause.start, _DIGITS): pause for pause in said.pauses}
        self.boundary_of = {boundary.word: boundary.label for boundary in said.boundaries}
        self.stretches = {
            Level.PHRASE: self._split(self._ends_phrase),
            Level.UTTERANCE: self._split(self._ends_utterance),
            Level.TURN: self._split(self._ends_turn),
        }
        self._questions = [self._question(u) for u in self.stretches[Level.UTTERANCE]]
        self._groups = list(self._grouped())
        self._rates = [self._rate(p) for p in self.stretches[Level.PHRASE]]

    def after(self, word: int) -> Pause | None:
        """Return the pause after a word, by its index, None where there is none."""
        return self._pause_at.get(round(self.said.words[word].end, _DIGITS))

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

    def _ends_phrase(self, word: int) -> bool:
        return word in self.boundary_of or self.after(word) is not None

    def _ends_utterance(self, word: int) -> bool:
        pause = self.after(word)
        return pause is not None and pause.kind in SENTENCE_ENDS

    def _ends_turn(self, word: int) -> bool:
        if word + 1 == len(self.said.words):
            return True
        end, begin = self.said.words[word].end, self.said.words[word + 1].start
        return any(start < begin and end < stop for start, stop in self._listening)

    def _split(self, ends: Callable[[int], bool]) -> list[Stretch]:
        words = self.said.words
        edges = [0, *(i + 1 for i in range(len(words)) if i + 1 == len(words) or ends(i))]
        return [
            Stretch(a, b, words[a].start, words[b - 1].end, self.after(b - 1)) for a, b in pairwise(edges)
        ]

    def _question(self, stretch: Stretch) -> Question:
        if stretch.pause is None or stretch.pause.kind is not PauseKind.QUESTION:
            return Question.NONE
        texts = [w.text.lower() for w in self.said.words[stretch.first : stretch.last]]
        table = intonation_table().questions
        if any(text in table.wh for text in texts[:2]):
            return Question.WH
        inverted = any(text in table.auxiliaries for text in texts[:2])
        if inverted and any(text in table.alternative for text in texts[1:-1]):
            return Question.ALTERNATIVE
        return Question.YES_NO if inverted else Question.UNMARKED

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
