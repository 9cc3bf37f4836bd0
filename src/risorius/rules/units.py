"""Units of a performance: what rules are tried on, with all that a rule may ask about each."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from ..core.utterance import SILENCE, Accent, Pause, PauseKind, Utterance
from .intonation import intonation_table
from .rule import Level, Position, Question, TurnState
from .situation import Situation
from .synchrony import synchrony

# Seconds.
MOMENT = 1.0
_SENTENCE_ENDS = (PauseKind.FULL_STOP, PauseKind.QUESTION, PauseKind.EXCLAMATION, PauseKind.FINAL)


@dataclass(frozen=True, slots=True)
class Unit:
    """A stretch of seconds [start, end] and its facts.

    `text`: how messages name it. `accented`: where its accented syllable begins, the nuclear one of several.
    `rate`: syllables a second of its phrase. `group`: which run of related utterances it belongs to.
    """

    level: Level
    index: int
    start: float
    end: float
    text: str
    accents: tuple[Accent, ...] = ()
    accented: float | None = None
    boundary: str | None = None
    pause: PauseKind | None = None
    question: Question = Question.NONE
    stress: int = -1
    position: Position = Position.ONLY
    phone: str = ""
    words: frozenset[str] = frozenset()
    rate: float = field(default_factory=lambda: synchrony().usual_rate)
    group: int = 0
    emotions: Mapping[str, float] = field(default_factory=dict)
    turn: TurnState = TurnState.SPEAKING

    @property
    def middle(self) -> float:
        """Seconds."""
        return 0.5 * (self.start + self.end)


@dataclass(frozen=True, slots=True)
class _Stretch:
    """Words [first, last) of a phrase, an utterance or a turn, seconds, and the pause after it."""

    first: int
    last: int
    start: float
    end: float
    pause: Pause | None


class Units:
    """All units of a situation, by level."""

    def __init__(self, situation: Situation) -> None:
        self.situation = situation
        self._said = situation.utterance

    def of(self, level: Level) -> tuple[Unit, ...]:
        """Return the units of a level in order; none of those that speech has where nothing is said."""
        if level is Level.MOMENT:
            return tuple(self._moments())
        if self._said is None or not self._said.words:
            return ()
        return self._by_level[level]

    @cached_property
    def boundaries(self) -> tuple[float, ...]:
        """Return where phonemes begin and end, seconds, in order."""
        if self._said is None:
            return ()
        return (0.0, *(phone.end for phone in self._said.phones))

    @cached_property
    def _by_level(self) -> dict[Level, tuple[Unit, ...]]:
        assert self._said is not None
        spoken = _Spoken(self._said, self.situation)
        makers: dict[Level, Callable[[], Iterator[Unit]]] = {
            Level.PHONEME: spoken.phonemes,
            Level.SYLLABLE: spoken.syllables,
            Level.WORD: spoken.words,
            Level.ITEM: spoken.items,
            Level.PHRASE: lambda: spoken.stretches(Level.PHRASE),
            Level.UTTERANCE: lambda: spoken.stretches(Level.UTTERANCE),
            Level.TURN: lambda: spoken.stretches(Level.TURN),
            Level.PAUSE: spoken.pauses,
        }
        return {level: tuple(make()) for level, make in makers.items()}

    def _moments(self) -> Iterator[Unit]:
        s = self.situation
        for index in range(int(s.duration / MOMENT)):
            start = index * MOMENT
            middle = start + 0.5 * MOMENT
            yield Unit(
                Level.MOMENT, index, start, start + MOMENT, f"{start:g} s",
                emotions=s.emotions_at(middle), turn=s.turn_at(middle),
            )  # fmt: skip


class _Spoken:
    """The units of what is said; there is at least one word."""

    def __init__(self, said: Utterance, situation: Situation) -> None:
        self.said, self.situation = said, situation
        self._pause_at = {pause.start: pause for pause in said.pauses}
        self._boundary_of = {boundary.word: boundary.label for boundary in said.boundaries}
        self.levels = {
            Level.PHRASE: self._split(self._ends_phrase),
            Level.UTTERANCE: self._split(self._ends_utterance),
            Level.TURN: self._split(self._ends_turn),
        }
        self._questions = [self._question(u) for u in self.levels[Level.UTTERANCE]]
        self._groups = self._grouped()
        self._rates = [self._rate(p) for p in self.levels[Level.PHRASE]]

    def _after(self, word: int) -> Pause | None:
        return self._pause_at.get(self.said.words[word].end)

    def _ends_phrase(self, word: int) -> bool:
        return word in self._boundary_of or self._after(word) is not None

    def _ends_utterance(self, word: int) -> bool:
        pause = self._after(word)
        return pause is not None and pause.kind in _SENTENCE_ENDS

    def _ends_turn(self, word: int) -> bool:
        if word + 1 == len(self.said.words):
            return True
        end, begin = self.said.words[word].end, self.said.words[word + 1].start
        return any(start < begin and end < stop for start, stop in self.situation.listening)

    def _split(self, ends: Callable[[int], bool]) -> list[_Stretch]:
        words = self.said.words
        edges = [0, *(i + 1 for i in range(len(words)) if i + 1 == len(words) or ends(i))]
        return [
            _Stretch(a, b, words[a].start, words[b - 1].end, self._after(b - 1)) for a, b in pairwise(edges)
        ]

    def _question(self, stretch: _Stretch) -> Question:
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

    def _grouped(self) -> list[int]:
        """Return the group of each utterance: a long silence or a new line begins another subject."""
        groups, group = [], 0
        utterances = self.levels[Level.UTTERANCE]
        for before, after in pairwise((None, *utterances)):
            if before is not None and after is not None:
                words = self.said.words
                between = self.said.text[words[before.last - 1].source_end : words[after.first].source_start]
                group += "\n" in between or after.start - before.end > synchrony().group_pause
            groups.append(group)
        return groups

    def _rate(self, phrase: _Stretch) -> float:
        first = bisect_left(self.said.syllables, phrase.first, key=lambda s: s.word)
        last = bisect_left(self.said.syllables, phrase.last, key=lambda s: s.word)
        return (last - first) / (phrase.end - phrase.start) if last > first else synchrony().usual_rate

    def _index(self, level: Level, word: int) -> int:
        return bisect_right(self.levels[level], word, key=lambda s: s.first) - 1

    def _unit(self, level: Level, index: int, start: float, end: float, text: str, word: int) -> Unit:
        """Begin a unit whose first word is number `word`."""
        utterance = self._index(Level.UTTERANCE, word)
        return Unit(
            level, index, start, end, text,
            question=self._questions[utterance],
            group=self._groups[utterance],
            rate=self._rates[self._index(Level.PHRASE, word)],
            emotions=self.situation.emotions_at(0.5 * (start + end)),
            turn=self.situation.turn_at(start),
        )  # fmt: skip

    def _texts(self, index: int) -> frozenset[str]:
        """Return a word's text, and those of the two and three words that begin with it."""
        texts = [w.text.lower().replace("’", "'") for w in self.said.words[index : index + 3]]
        return frozenset(" ".join(texts[: n + 1]) for n in range(len(texts)))

    def _accented(self, accents: Sequence[Accent]) -> dict[str, Any]:
        """Return a unit's accents, and where the syllable of the nuclear one, or of the last, begins."""
        chief = next((a for a in accents if a.nuclear), accents[-1] if accents else None)
        start = None if chief is None else self.said.syllables[chief.syllable].start
        return {"accents": tuple(accents), "accented": start}

    def phonemes(self) -> Iterator[Unit]:
        """Yield the spoken phones."""
        for index, phone in enumerate(self.said.phones):
            if phone.symbol == SILENCE or phone.word < 0:
                continue
            word = self.said.words[phone.word]
            draft = self._unit(
                Level.PHONEME, index, phone.start, phone.end, f'/{phone.symbol}/ of "{word.text}"', phone.word
            )
            last = index + 1 == word.last_phone
            yield replace(
                draft,
                stress=phone.stress,
                phone=phone.symbol,
                words=frozenset({word.text.lower()}),
                position=_position(index - word.first_phone, word.last_phone - word.first_phone),
                pause=_kind(self._after(phone.word)) if last else None,
            )

    def syllables(self, level: Level = Level.SYLLABLE) -> Iterator[Unit]:
        """Yield the syllables."""
        said = self.said.syllables
        accents = {accent.syllable: accent for accent in self.said.accents}
        for index, s in enumerate(said):
            word = self.said.words[s.word]
            last = index + 1 == len(said) or said[index + 1].word != s.word
            inside = [
                i for i in range(max(0, index - 9), index + 10) if i < len(said) and said[i].word == s.word
            ]
            yield replace(
                self._unit(level, index, s.start, s.end, f'"{word.text}"', s.word),
                **self._accented([accents[index]] if index in accents else []),
                stress=s.stress,
                words=frozenset({word.text.lower()}),
                position=_position(inside.index(index), len(inside)),
                boundary=self._boundary_of.get(s.word) if last else None,
                pause=_kind(self._after(s.word)) if last else None,
            )

    def words(self, level: Level = Level.WORD) -> Iterator[Unit]:
        """Yield the words."""
        accents = _by_word(self.said.accents)
        stresses = {s.word: 0 for s in self.said.syllables}
        for s in self.said.syllables:
            stresses[s.word] = max(stresses[s.word], s.stress)
        for index, word in enumerate(self.said.words):
            phrase = self.levels[Level.PHRASE][self._index(Level.PHRASE, index)]
            yield replace(
                self._unit(level, index, word.start, word.end, f'"{word.text}"', index),
                **self._accented(accents.get(index, [])),
                stress=stresses.get(index, 0),
                words=self._texts(index),
                position=_position(index - phrase.first, phrase.last - phrase.first),
                boundary=self._boundary_of.get(index),
                pause=_kind(self._after(index)),
            )

    def items(self) -> Iterator[Unit]:
        """Yield words, and the syllables of phrases that are spoken slowly (paper B, section 4.1)."""
        limit = synchrony().slow_rate
        slow = [s for s in self.syllables(Level.ITEM) if s.rate < limit]
        fast = [w for w in self.words(Level.ITEM) if w.rate >= limit]
        yield from sorted([*slow, *fast], key=lambda unit: unit.start)

    def stretches(self, level: Level) -> Iterator[Unit]:
        """Yield phrases, utterances or turns."""
        stretches = self.levels[level]
        within = Level.UTTERANCE if level is Level.PHRASE else Level.TURN
        owners = [self._index(within, s.first) for s in stretches]
        for index, s in enumerate(stretches):
            siblings = owners.count(owners[index]) if level is not Level.TURN else len(stretches)
            place = index - (owners.index(owners[index]) if level is not Level.TURN else 0)
            text = " ".join(w.text for w in self.said.words[s.first : s.last])
            yield replace(
                self._unit(level, index, s.start, s.end, f'"{text}"', s.first),
                **self._accented([a for a in self.said.accents if s.first <= a.word < s.last]),
                boundary=self._boundary_of.get(s.last - 1),
                pause=_kind(s.pause),
                question=self._questions[self._index(Level.UTTERANCE, s.last - 1)],
                position=_position(place, siblings),
            )

    def pauses(self) -> Iterator[Unit]:
        """Yield the pauses."""
        pauses = self.said.pauses
        for index, pause in enumerate(pauses):
            before = bisect_right(self.said.words, pause.start, key=lambda w: w.end) - 1
            draft = self._unit(
                Level.PAUSE, index, pause.start, pause.end, f"the {pause.kind} pause", max(before, 0)
            )
            yield replace(draft, pause=pause.kind, position=_position(index, len(pauses)))


def _kind(pause: Pause | None) -> PauseKind | None:
    return None if pause is None else pause.kind


def _position(index: int, count: int) -> Position:
    if count == 1:
        return Position.ONLY
    if index == 0:
        return Position.FIRST
    return Position.LAST if index + 1 == count else Position.INNER


def _by_word(accents: Sequence[Accent]) -> dict[int, list[Accent]]:
    found: dict[int, list[Accent]] = {}
    for accent in accents:
        found.setdefault(accent.word, []).append(accent)
    return found
