"""A language as the other stages know it, and the tables that its folder holds."""

from __future__ import annotations

import unicodedata
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Annotated

from ..core.speech.utterance import Question
from ..reading.hints import Range
from .abbreviations import Abbreviations
from .intonation import IntonationTable
from .mnemonics import Mnemonics

APOSTROPHES = "'\u2019\u02bc"
_STRAIGHT = str.maketrans(dict.fromkeys(APOSTROPHES, "'"))

# Letters that are left of a word without its ending.
_SHORTEST_STEM = 3

# How a whole number, written in digits, may be read, in words; none for what is not a number.
NumberReadings = Callable[[str], tuple[str, ...]]


def plain_word(text: str) -> str:
    """Return a word as tables have it: in lower case, composed, with straight apostrophes."""
    return unicodedata.normalize("NFC", text).lower().translate(_STRAIGHT)


@dataclass(frozen=True, slots=True)
class Questions:
    """Words that tell the kinds of questions apart.

    Of the first two words of a question, `openers` not counted, one of `wh` asks for information, one of
    `yes_no` for yes or no, whichever comes first; the latter, as the second word, only if none of `subjects`
    comes before it and one of `pronouns` after it: else it is a statement's verb.
    If `verb_first`, any word before one of `subjects` that is not a function word is a verb and asks for yes
    or no; so does a word that a hyphen joins to one of `hyphenated`. One of `last` asks for information as
    the last word, one of `anywhere` (words, or several) wherever it stands; one of `last_yes_no` asks for yes
    or no at the end, whatever stands before; so does, if `tags`, one of `yes_no` before one of `pronouns` at
    the end of a statement ("He did it, didn't he?"). One of `alternative` offers a choice. Else a question
    asks `otherwise`.
    """

    openers: tuple[str, ...] = ()
    wh: tuple[str, ...] = ()
    anywhere: tuple[str, ...] = ()
    yes_no: tuple[str, ...] = ()
    subjects: tuple[str, ...] = ()
    pronouns: tuple[str, ...] = ()
    verb_first: bool = False
    hyphenated: tuple[str, ...] = ()
    last: tuple[str, ...] = ()
    last_yes_no: tuple[str, ...] = ()
    tags: bool = False
    alternative: tuple[str, ...] = ()
    otherwise: Question = Question.YES_NO


@dataclass(frozen=True, slots=True)
class Clauses:
    """Words before which a phrase may begin without a pause, if both parts have at least `least` words."""

    before: tuple[str, ...] = ()
    least: Annotated[int, Range(1, 50)] = 3


class Nouns(StrEnum):
    """The way to tell nouns from other content words."""

    CAPITALS = "capitals"
    DETERMINERS = "determiners"


@dataclass(frozen=True, slots=True)
class AccentPlaces:
    """Content words that carry no accent because of their position.

    `trailing`: words at the end of a phrase that the nucleus passes over. `verbs`: how verbs look that end a
    clause and are unaccented right after a noun ("ge…t": "…" is two letters or more), but those of
    `not_verbs`; a noun has a capital, or one of `determiners` shortly before it and none of the endings
    `adjectives`. `group`: most syllables of content words in a row of which only the last is accented, 0 for
    none. `clash`: no accent right before another one.
    """

    trailing: tuple[str, ...] = ()
    verbs: tuple[str, ...] = ()
    not_verbs: tuple[str, ...] = ()
    nouns: Nouns = Nouns.DETERMINERS
    determiners: tuple[str, ...] = ()
    adjectives: tuple[str, ...] = ()
    group: Annotated[int, Range(0, 20)] = 0
    clash: bool = False


@dataclass(frozen=True, slots=True)
class Discourse:
    """Clues that tell given, new and contrasted words apart.

    `endings`: left out when words are compared ("prefers", "preferred"). `topics`: words of a question before
    its new topic ("what about"). `negations` and `corrections`: "not tea but coffee".
    `subjects`: words that ask for a subject ("who").
    """

    endings: tuple[str, ...] = ()
    topics: tuple[str, ...] = ()
    negations: tuple[str, ...] = ()
    corrections: tuple[str, ...] = ()
    subjects: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class LanguageTable:
    """The file `language.toml`.

    `tested`: whether real texts were spoken and compared with published rules. `tones`: pitch tells words
    apart. `function_words`: words that normally carry no accent, by kind.
    `fillers`: sounds of hesitation. `spaces`: blanks stand between words.
    """

    name: str
    tested: bool = False
    tones: bool = False
    spaces: bool = True
    function_words: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    fillers: tuple[str, ...] = ()
    questions: Questions = Questions()
    clauses: Clauses = Clauses()
    accents: AccentPlaces = AccentPlaces()
    discourse: Discourse = Discourse()


@dataclass(frozen=True, slots=True)
class PhoneTable:
    """The file `phones.toml`.

    `arpabet`: phones are ARPAbet, else IPA. `onsets`: clusters of ARPAbet that begin words. `spellings`: the
    IPA of what espeak-ng spells otherwise. `tones`: letters of the IPA for espeak-ng's digits of tones.
    """

    arpabet: bool = False
    onsets: tuple[str, ...] = ()
    spellings: Mapping[str, str] = field(default_factory=dict)
    tones: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class WordList:
    """The file `words.toml`: words, by kind, of a script that puts no blanks between them."""

    words: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Language:
    """The tables of a language. `code`: that of its folder, "und" for a language without one."""

    code: str
    name: str
    tested: bool
    tones: bool
    spaces: bool
    arpabet: bool
    function_words: frozenset[str]
    fillers: frozenset[str]
    questions: Questions
    clauses: Clauses
    accents: AccentPlaces
    discourse: Discourse
    onsets: frozenset[tuple[str, ...]]
    spellings: Mapping[str, str]
    tone_letters: Mapping[str, str]
    words: frozenset[str]
    abbreviations: Abbreviations
    mnemonics: Mnemonics
    intonation: IntonationTable
    number_readings: NumberReadings

    def is_function_word(self, text: str) -> bool:
        """Tell whether a word normally has no accent; a word with apostrophes has none if no part has one."""
        word = plain_word(text)
        return word in self.function_words or (
            "'" in word and all(part in self.function_words for part in word.split("'"))
        )

    def stem(self, text: str) -> str:
        """Return the part that the forms of a word have in common: "prefer" of "prefers" and "preferred"."""
        word = plain_word(text)
        fitting = (end for end in self.discourse.endings if word.endswith(end))
        longest = max((end for end in fitting if len(word) - len(end) >= _SHORTEST_STEM), key=len, default="")
        stem = word.removesuffix(longest)
        if self.discourse.endings and len(stem) > _SHORTEST_STEM:
            stem = stem.removesuffix("e")
            stem = f"{stem[:-1]}y" if stem.endswith("i") else stem
            stem = stem[:-1] if stem[-1] == stem[-2] else stem
        return stem
