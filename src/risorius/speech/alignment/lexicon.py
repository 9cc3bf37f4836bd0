"""Readings of a transcript's words: the dictionary's, and espeak-ng's for the words that it lacks.

The whole transcript is spoken by espeak-ng first. That reads numbers and abbreviations out, tells every word
its stress in context, and gives a reading to words out of the dictionary. The words of the dictionary
(CMUdict) keep all their readings there: the decoder hears which one is said.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Sequence
from itertools import islice, product
from typing import NamedTuple

from ...core.speech.utterance import Utterance, Word
from ...languages import language_of, phonesets
from ..synthesis import synthesize_line
from .decoder import MODEL_LANGUAGE, Reading, Readings, dictionary_path

MOST_READINGS = 8
_CURLY = str.maketrans("\u2019\u02bc\u2010\u2011", "''--")


class OwnPhone(NamedTuple):
    """A phone of another language than the model's, and how many of the model's stand for it."""

    symbol: str
    parts: int


class ScriptWord(NamedTuple):
    """A word of the transcript: its place, how it may be said, and its vowels' stress in context.

    `own`: its phones, if they are not the model's; then it has one reading.
    """

    word: Word
    readings: Readings
    stresses: tuple[int, ...]
    own: tuple[OwnPhone, ...] = ()


def read_transcript(text: str, language: str | None = None) -> tuple[Utterance, tuple[ScriptWord, ...]]:
    """Return the transcript as espeak-ng says it, and its words; raise InputError if nothing can be said.

    `language` is that of the words, the model's by default. The phones of another one are read as the nearest
    of the model's.
    """
    spoken = synthesize_line(text, language=language)
    read = _script_word if language_of(spoken.language).arpabet else _foreign_word
    return spoken, tuple(read(spoken, word) for word in spoken.words)


def _foreign_word(spoken: Utterance, word: Word) -> ScriptWord:
    """Return a word of another language, whose phones are IPA, by the nearest phones of the model."""
    phones = [phone for phone in spoken.phones[word.first_phone : word.last_phone] if phone.symbol]
    nearest = [phonesets.to_arpabet(phone.symbol) for phone in phones]
    own = tuple(OwnPhone(p.symbol, len(parts)) for p, parts in zip(phones, nearest, strict=True) if parts)
    stresses = tuple(p.stress for p, parts in zip(phones, nearest, strict=True) if parts and p.stress >= 0)
    reading = tuple(part for parts in nearest for part in parts)
    if not reading:  # nothing of it can be heard: as little as the model has
        own, reading = (OwnPhone(phones[0].symbol, 1),), (phonesets.UNKNOWN_VOWEL,)
    return ScriptWord(word, (reading,), stresses, own)


def stresses_of(reading: Sequence[str], engine: Sequence[int]) -> list[int]:
    """Return the stress of every phone of a reading (-1 for consonants), given the engine's per vowel."""
    vowels = [index for index, phone in enumerate(reading) if phonesets.is_vowel(phone)]
    stresses = [-1] * len(reading)
    for number, index in enumerate(vowels):
        if not engine:
            stresses[index] = 0
        elif len(engine) == len(vowels):
            stresses[index] = engine[number]
        else:
            stresses[index] = engine[round(number * (len(engine) - 1) / max(len(vowels) - 1, 1))]
    return stresses


def _script_word(spoken: Utterance, word: Word) -> ScriptWord:
    phones = spoken.phones[word.first_phone : word.last_phone]
    sounding = [phone for phone in phones if phone.symbol]
    stresses = tuple(phone.stress for phone in sounding if phone.stress >= 0)
    said = tuple(phone.symbol for phone in sounding)
    readings = written_readings(word.text) or (said,)
    if any(char.isdigit() for char in word.text):
        # What stands around it may decide how a number is said: "March 3".
        readings = tuple(dict.fromkeys((said, *readings)))
    return ScriptWord(word, readings, stresses)


def written_readings(text: str) -> Readings:
    """Return the readings of a written word by dictionary and rules; none if these do not know it."""
    plain = text.translate(_CURLY)
    if numbers := language_of(MODEL_LANGUAGE).number_readings(plain):
        return _first(reading for words in numbers for reading in _read_all(words.split()))
    readings = [*_entry(plain.lower())]
    if len(plain) > 1 and plain.isupper() and plain.isalpha():
        readings += _read_all(list(plain))
    if not readings and "-" in plain:
        readings += _read_all([part for part in plain.split("-") if part])
    return _first(iter(readings))


def _first(readings: Iterator[Reading]) -> Readings:
    return tuple(islice(dict.fromkeys(readings), MOST_READINGS))


def _read_all(words: Sequence[str]) -> list[Reading]:
    """Return the readings of words in a row; none if one of them is not in the dictionary."""
    known = [tuple(_entry(word.lower())) for word in words]
    return [
        tuple(phone for part in parts for phone in part) for parts in islice(product(*known), MOST_READINGS)
    ]


def _entry(word: str) -> Iterator[Reading]:
    """Yield the readings of a word in the dictionary: "read", "read(2)" …"""
    entries, number = _dictionary(), 1
    phones = None if "(" in word else entries.get(word)
    while phones is not None:
        yield tuple(phones.split())
        number += 1
        phones = entries.get(f"{word}({number})")


@functools.cache
def _dictionary() -> dict[str, str]:
    """Return each entry's phones; most are never asked for, and are not divided."""
    lines = dictionary_path().read_text(encoding="utf-8").splitlines()
    return dict(line.split(None, 1) for line in lines)
