"""The units of speech, level by level."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from typing import Any, Protocol

from ..core.speech.utterance import SILENCE, Accent, Pause, PauseKind, Utterance
from .discourse import Turn, groups_of, rate_of_phrase, turns_of
from .rule import Level, Position
from .rule_span import RuleSpan
from .situation import Situation
from .synchrony import synchrony

# Words of a stretch that messages show.
_SHOWN = 8


class TimeRange(Protocol):
    """Anything that has a start and an end, in seconds."""

    @property
    def start(self) -> float:
        """Its start in seconds."""

    @property
    def end(self) -> float:
        """Its end in seconds."""


class WordRange(TimeRange, Protocol):
    """Words [first_word, last_word): a phrase, a sentence or a turn."""

    @property
    def first_word(self) -> int:
        """The first of its words."""

    @property
    def last_word(self) -> int:
        """The word after its last one."""


class SpeechSpans:
    """Makes the units of a situation in which something is said."""

    def __init__(self, said: Utterance, situation: Situation) -> None:
        self.said, self.situation = said, situation
        self._stretches: dict[Level, Sequence[WordRange]] = {
            Level.PHRASE: said.phrases,
            Level.UTTERANCE: said.sentences,
            Level.TURN: turns_of(said, situation.listening),
        }
        self._first_words = {level: [s.first_word for s in own] for level, own in self._stretches.items()}
        self._accented_words = [accent.word for accent in said.accents]
        self._boundary_of = {boundary.word: boundary.label for boundary in said.boundaries}
        self._groups = list(groups_of(said))
        self._rates = [rate_of_phrase(said, phrase) for phrase in said.phrases]
        self._lowered = [word.text.lower().replace("’", "'") for word in said.words]
        self._syllables_of = Counter(s.word for s in said.syllables)

    def _unit(
        self, level: Level, counts: Counter[int], spoken: TimeRange, text: str, word: int, **more: Any
    ) -> RuleSpan:
        """Return the unit that something spoken is, whose first word is number `word`.

        `counts` has how many units of the level came before it, by phrase.
        """
        start, end = spoken.start, spoken.end
        # When a turn will end is not known at its start.
        felt = start if level is Level.TURN else 0.5 * (start + end)
        phrase = self._index(Level.PHRASE, word)
        sentence = self.said.phrases[phrase].sentence
        number, counts[phrase] = counts[phrase], counts[phrase] + 1
        more.setdefault("question", self.said.phrases[phrase].question)
        return RuleSpan(
            level, phrase, number, start, end, text,
            group=self._groups[sentence],
            rate=self._rates[phrase],
            emotions=self.situation.emotions_at(felt),
            turn=self.situation.turn_at(start),
            **more,
        )  # fmt: skip

    def _texts(self, index: int) -> frozenset[str]:
        """Return a word's text, and those of the two and three words of its sentence that begin with it."""
        end = self._stretches[Level.UTTERANCE][self._index(Level.UTTERANCE, index)].last_word
        texts = self._lowered[index : min(index + 3, end)]
        return frozenset([" ".join(texts[: n + 1]) for n in range(len(texts))])

    def _accented(self, accents: Sequence[Accent]) -> dict[str, Any]:
        """Return a unit's accents, and where the syllable of the nuclear one, or of the last, begins."""
        chief = next((a for a in accents if a.nuclear), accents[-1] if accents else None)
        start = None if chief is None else self.said.syllables[chief.syllable].start
        return {"accents": tuple(accents), "accented": start}

    def _ending(self, word: int, last: bool) -> dict[str, Any]:
        """Return the boundary and the pause after a word, for the unit that ends it."""
        if not last:
            return {}
        return {"boundary": self._boundary_of.get(word), "pause": _kind(self.said.pause_after(word))}

    def phonemes(self) -> Iterator[RuleSpan]:
        """Yield the spoken phones."""
        counts = Counter[int]()
        for index, phone in enumerate(self.said.phones):
            if phone.symbol == SILENCE or phone.word < 0:
                continue
            word = self.said.words[phone.word]
            text = f'/{phone.symbol}/ of "{word.text}"'
            yield self._unit(
                Level.PHONEME, counts, phone, text, phone.word,
                stress=phone.stress,
                phone=phone.symbol,
                words=frozenset({word.text.lower()}),
                position=_position(index - word.first_phone, word.last_phone - word.first_phone),
                **self._ending(phone.word, index + 1 == word.last_phone),
            )  # fmt: skip

    def syllables(
        self, level: Level = Level.SYLLABLE, phrases: Container[int] | None = None
    ) -> Iterator[RuleSpan]:
        """Yield the syllables, of some `phrases` or of all."""
        accents = {accent.syllable: accent for accent in self.said.accents}
        counts = Counter[int]()
        place = 0
        for index, s in enumerate(self.said.syllables):
            place = place + 1 if index and self.said.syllables[index - 1].word == s.word else 0
            if phrases is not None and self._index(Level.PHRASE, s.word) not in phrases:
                continue
            count = self._syllables_of[s.word]
            text = self.said.words[s.word].text
            yield self._unit(
                level, counts, s, f'"{text}"', s.word,
                **self._accented([accents[index]] if index in accents else []),
                stress=s.stress,
                words=frozenset({text.lower()}),
                position=_position(place, count),
                **self._ending(s.word, place + 1 == count),
            )  # fmt: skip

    def words(self, level: Level = Level.WORD, phrases: Container[int] | None = None) -> Iterator[RuleSpan]:
        """Yield the words, of some `phrases` or of all."""
        counts = Counter[int]()
        stresses: dict[int, int] = {}
        for s in self.said.syllables:
            stresses[s.word] = max(stresses.get(s.word, 0), s.stress)
        for index, word in enumerate(self.said.words):
            number = self._index(Level.PHRASE, index)
            if phrases is not None and number not in phrases:
                continue
            phrase = self.said.phrases[number]
            yield self._unit(
                level, counts, word, f'"{word.text}"', index,
                **self._accented(self._accents(index, index + 1)),
                stress=stresses.get(index, 0),
                words=self._texts(index),
                position=_position(index - phrase.first_word, phrase.last_word - phrase.first_word),
                **self._ending(index, True),
            )  # fmt: skip

    def _accents(self, first: int, last: int) -> tuple[Accent, ...]:
        """Return the accents on words [first, last)."""
        return self.said.accents[
            bisect_left(self._accented_words, first) : bisect_left(self._accented_words, last)
        ]

    def items(self) -> Iterator[RuleSpan]:
        """Yield words, and the syllables of phrases that are spoken slowly (paper B, section 4.1)."""
        limit = synchrony().slow_rate
        slow = {number for number, rate in enumerate(self._rates) if rate < limit}
        fast = {number for number in range(len(self._rates)) if number not in slow}
        units = [*self.syllables(Level.ITEM, slow), *self.words(Level.ITEM, fast)]
        yield from sorted(units, key=lambda unit: unit.start)

    def stretches(self, level: Level) -> Iterator[RuleSpan]:
        """Yield phrases, by their place in the utterance, utterances, by that in the turn, or turns."""
        stretches = self._stretches[level]
        positions = _positions(self._owner(level, s.first_word) for s in stretches)
        counts = Counter[int]()
        for s, position in zip(stretches, positions, strict=True):
            text = f'"{self._text(self._naming(level, s))}"'
            yield self._unit(
                level, counts, s, text, s.first_word,
                **self._accented(self._accents(s.first_word, s.last_word)),
                **self._ending(s.last_word - 1, True),
                question=self.said.phrases[self._index(Level.PHRASE, s.last_word - 1)].question,
                position=position,
            )  # fmt: skip

    def information(self) -> Iterator[RuleSpan]:
        """Yield themes and rhemes, by their place in the utterance; one without words is left out."""
        words = self.said.words
        found = []
        for span in self.situation.information:
            first, last = (bisect_left(words, t, key=lambda w: w.start) for t in (span.start, span.end))
            if first < last:
                found.append((span.part, first, last))
        positions = _positions(self._index(Level.UTTERANCE, first) for _, first, _ in found)
        counts = Counter[int]()
        for (part, first, last), position in zip(found, positions, strict=True):
            stretch = Turn(first, last, words[first].start, words[last - 1].end)
            yield self._unit(
                Level.INFORMATION, counts, stretch, f'the {part} "{self._text(stretch)}"', first,
                **self._ending(last - 1, True),
                information=part,
                position=position,
            )  # fmt: skip

    def _naming(self, level: Level, stretch: WordRange) -> WordRange:
        """Return by whose words messages name a stretch: of a turn, which may go on, its first sentence's."""
        if level is not Level.TURN:
            return stretch
        return self._stretches[Level.UTTERANCE][self._index(Level.UTTERANCE, stretch.first_word)]

    def _text(self, stretch: WordRange) -> str:
        """Return the first words of a stretch, to name it by."""
        words = [word.text for word in self.said.words[stretch.first_word : stretch.last_word]]
        return " ".join(words[:_SHOWN]) + (" …" if len(words) > _SHOWN else "")

    def _owner(self, level: Level, word: int) -> int:
        """Return which of the next larger stretches a word belongs to; turns belong to the whole."""
        if level is Level.TURN:
            return 0
        return self._index(Level.UTTERANCE if level is Level.PHRASE else Level.TURN, word)

    def _index(self, level: Level, word: int) -> int:
        """Return which phrase, utterance or turn holds a word."""
        return bisect_right(self._first_words[level], word) - 1

    def pauses(self) -> Iterator[RuleSpan]:
        """Yield the pauses."""
        pauses, words = self.said.pauses, self.said.words
        counts = Counter[int]()
        for index, pause in enumerate(pauses):
            before = bisect_right(words, pause.start, key=lambda w: w.end) - 1
            text = f"the {pause.kind} pause"
            floor = pauses[index - 1].end if index else 0.0
            ceiling = pauses[index + 1].start if index + 1 < len(pauses) else self.said.duration
            yield self._unit(
                Level.PAUSE, counts, pause, text, max(before, 0),
                pause=pause.kind, position=_position(index, len(pauses)),
                before=(floor, words[before].start) if before >= 0 else None,
                after=(words[before + 1].end, ceiling) if before + 1 < len(words) else None,
            )  # fmt: skip


def _kind(pause: Pause | None) -> PauseKind | None:
    return None if pause is None else pause.kind


def _positions(owners: Iterable[int]) -> Iterator[Position]:
    """Yield the position of each of some units among those with the same owner; owners come in order."""
    listed = list(owners)
    counts, seen = Counter(listed), Counter[int]()
    for owner in listed:
        yield _position(seen[owner], counts[owner])
        seen[owner] += 1


def _position(index: int, count: int) -> Position:
    if count == 1:
        return Position.ONLY
    if index == 0:
        return Position.FIRST
    return Position.LAST if index + 1 == count else Position.INNER
