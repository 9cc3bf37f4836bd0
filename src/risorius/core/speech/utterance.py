"""An utterance: phones, syllables, words, phrases, pauses and accents with their times, and the sound."""

from __future__ import annotations

import textwrap
from bisect import bisect_left
from dataclasses import dataclass
from enum import StrEnum
from itertools import groupby, pairwise
from typing import Annotated

from ...reading.hints import Range
from ..time import put_on_ticks, ticks_of
from ..units import Seconds, Share
from .audio import Audio

SILENCE = ""
Stress = Annotated[int, Range(-1, 2)]
SourceIndex = Annotated[int, Range(0, 2**31)]
"""A place in the text that was spoken, in characters."""


class PauseKind(StrEnum):
    """The function of a pause (paper B, section 2.1: punctuators)."""

    INITIAL = "initial"
    COMMA = "comma"
    FULL_STOP = "full_stop"
    QUESTION = "question"
    EXCLAMATION = "exclamation"
    HESITATION = "hesitation"
    FINAL = "final"


SENTENCE_ENDS = (PauseKind.FULL_STOP, PauseKind.QUESTION, PauseKind.EXCLAMATION, PauseKind.FINAL)
"""Pauses that end a sentence."""


class Question(StrEnum):
    """The type of a question. UNMARKED: only the question mark shows it (paper B, section 5.2)."""

    NONE = "none"
    WH = "wh"
    YES_NO = "yes_no"
    ALTERNATIVE = "alternative"
    UNMARKED = "unmarked"


class Ending(StrEnum):
    """The end of a phrase.

    PAUSE: in a silence without punctuation. CLAUSE: without a silence. OPEN: with the text, without
    punctuation.
    """

    STATEMENT = "statement"
    EXCLAMATION = "exclamation"
    CONTINUATION = "continuation"
    HESITATION = "hesitation"
    WH_QUESTION = "wh_question"
    YES_NO_QUESTION = "yes_no_question"
    ALTERNATIVE_QUESTION = "alternative_question"
    PAUSE = "pause"
    CLAUSE = "clause"
    OPEN = "open"


@dataclass(frozen=True, slots=True)
class Phone:
    """A speech sound; `symbol` is ARPAbet without stress digit (IPA for other languages), "" for silence.

    `stress`: 2 primary, 1 secondary, 0 none for vowels; -1 for consonants and silence. `word`: index of its
    word, -1 for silence. `tone`: the pitch that tells the word apart, in letters of the IPA ("˥˩"), on
    a vowel; "" if it has none or its tone is unknown. Stops start where the articulators close. Seconds.
    """

    symbol: str
    start: Seconds
    end: Seconds
    stress: Stress = -1
    word: int = -1
    tone: str = ""

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end")

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.end - self.start


@dataclass(frozen=True, slots=True)
class Syllable:
    """Phones [first_phone, last_phone) around one vowel. `stress` as in Phone. Seconds.

    `loudness`: dB above the speaker's mean syllable. `prominence`: by pitch, loudness and length together,
    and `pitch`: of its vowel, both in standard deviations of the speaker's. The speaker is known from
    the sound up to the next pause. All are 0 if the sound was not measured.
    """

    first_phone: int
    last_phone: int
    start: Seconds
    end: Seconds
    stress: Stress
    word: int
    loudness: float = 0.0
    prominence: float = 0.0
    pitch: float = 0.0

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end")


@dataclass(frozen=True, slots=True)
class Word:
    """A word: phones [first_phone, last_phone), characters [source_start, source_end). Seconds."""

    text: str
    start: Seconds
    end: Seconds
    first_phone: int
    last_phone: int
    source_start: SourceIndex
    source_end: SourceIndex

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end")


@dataclass(frozen=True, slots=True)
class Pause:
    """A silence and its function. Seconds."""

    start: Seconds
    end: Seconds
    kind: PauseKind

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end")


@dataclass(frozen=True, slots=True)
class Accent:
    """A pitch accent on a syllable; `label` is ToBI's, "*" if only its place is known. Seconds.

    `confidence`: 0..1, that there is an accent with this label.
    """

    time: Seconds
    word: int
    syllable: int
    label: str = "*"
    nuclear: bool = False
    confidence: Share = 1.0

    def __post_init__(self) -> None:
        put_on_ticks(self, "time")


@dataclass(frozen=True, slots=True)
class Boundary:
    """The tones that end a phrase after `word`; `label` is ToBI's ("L-L%", "H-"), "%" if unknown. Seconds.

    `confidence`: 0..1, that a phrase ends here with this label.
    """

    time: Seconds
    word: int
    label: str = "%"
    confidence: Share = 1.0

    def __post_init__(self) -> None:
        put_on_ticks(self, "time")


@dataclass(frozen=True, slots=True)
class Phrase:
    """Words [first_word, last_word) up to a pause, a boundary or the end of a sentence. Seconds.

    `sentence`: the number of its sentence, from 0 on; `question`: the type of that sentence.
    """

    first_word: int
    last_word: int
    start: float
    end: float
    sentence: int
    ending: Ending
    question: Question = Question.NONE

    def __post_init__(self) -> None:
        put_on_ticks(self, "start", "end")


@dataclass(frozen=True, slots=True)
class NamedTime:
    """The time of a place that the script names (SSML's `mark`, BML's `sync`). Seconds."""

    name: str
    time: Seconds

    def __post_init__(self) -> None:
        put_on_ticks(self, "time")


@dataclass(frozen=True, slots=True)
class Sentence:
    """Words [first_word, last_word), which are whole phrases, and their type of question. Seconds."""

    first_word: int
    last_word: int
    start: float
    end: float
    question: Question


@dataclass(frozen=True, slots=True)
class Utterance:
    """All that is known about an utterance.

    `phones` cover [0, duration] without a gap, silences included; `phrases` cover all words, in order.
    `marks`: the places that the script names, in the order of the text.
    """

    text: str
    language: str
    audio: Audio
    phones: tuple[Phone, ...]
    words: tuple[Word, ...]
    syllables: tuple[Syllable, ...] = ()
    pauses: tuple[Pause, ...] = ()
    accents: tuple[Accent, ...] = ()
    boundaries: tuple[Boundary, ...] = ()
    phrases: tuple[Phrase, ...] = ()
    marks: tuple[NamedTime, ...] = ()

    def __post_init__(self) -> None:
        check_continuous(self.phones, self.audio.duration)
        check_phrases(self.phrases, len(self.words))

    def __repr__(self) -> str:
        """Return one line: its duration and its text."""
        words, text = len(self.words), textwrap.shorten(self.text, 60)
        return f"<Utterance of {self.duration:.2f} s, {words} words, {len(self.phones)} phones, {text!r}>"

    @property
    def duration(self) -> float:
        """Seconds of sound, lead and tail included."""
        return self.audio.duration

    @property
    def sentences(self) -> tuple[Sentence, ...]:
        """The phrases of each sentence as one, in order."""
        grouped = [list(group) for _, group in groupby(self.phrases, key=lambda phrase: phrase.sentence)]
        return tuple(
            Sentence(p[0].first_word, p[-1].last_word, p[0].start, p[-1].end, p[0].question) for p in grouped
        )

    def pause_after(self, word: int) -> Pause | None:
        """Return the pause that follows a word, by its index; None if no pause follows."""
        end = self.words[word].end
        index = bisect_left(self.pauses, end, key=lambda pause: pause.start)
        following = self.pauses[index : index + 1]
        return following[0] if following and following[0].start == end else None


def check_phrases(phrases: tuple[Phrase, ...], words: int) -> None:
    """Raise ValueError if there are phrases that do not cover all words in order."""
    if not phrases:
        return
    starts, ends = [phrase.first_word for phrase in phrases], [phrase.last_word for phrase in phrases]
    if [*starts, words] != [0, *ends]:
        raise ValueError("phrases do not cover the words")
    if any(not p.first_word < p.last_word for p in phrases):
        raise ValueError("a phrase has no words")


def check_continuous(phones: tuple[Phone, ...], duration: float) -> None:
    """Raise ValueError unless the phones follow one another without gap or overlap over [0, duration]."""
    if not phones or phones[0].start != 0.0 or ticks_of(phones[-1].end) != ticks_of(duration):
        raise ValueError("phones do not cover the sound")
    if any(a.end != b.start for a, b in pairwise(phones)):
        raise ValueError("phones have a gap or overlap")
    if any(not p.start < p.end for p in phones):
        raise ValueError("a phone has no duration")
