"""Syllables by maximal onset."""

from __future__ import annotations

import pytest

from risorius.core.speech.utterance import Phone, Word
from risorius.languages import language_of, phonesets
from risorius.speech.structure.syllables import syllabify


def syllables(*words: str) -> list[str]:
    phones: list[Phone] = []
    spans: list[Word] = []
    for number, word in enumerate(words):
        first = len(phones)
        for symbol in word.split():
            at = 0.1 * len(phones)
            sound = "" if symbol == "_" else symbol
            stress = 2 if phonesets.is_vowel(sound) else -1
            phones.append(Phone(sound, at, at + 0.1, stress, number))
        spans.append(Word(word, 0.1 * first, 0.1 * len(phones), first, len(phones), 0, 1))
    found = syllabify(phones, spans, language_of("en"))
    assert all(
        s.start == phones[s.first_phone].start and s.end == phones[s.last_phone - 1].end for s in found
    )
    assert all(s.stress == 2 for s in found)
    return ["".join(p.symbol or "_" for p in phones[s.first_phone : s.last_phone]) for s in found]


@pytest.mark.parametrize("words", [(), ("HH M",), ("P S T",)])
def test_no_vowel_no_syllable(words) -> None:
    assert syllables(*words) == []


@pytest.mark.parametrize(
    ("word", "expected"),
    [
        ("B EY B IY", ["BEY", "BIY"]),
        ("EH K S T R AH", ["EHK", "STRAH"]),
        ("S IH NG IH NG", ["SIHNG", "IHNG"]),
        ("W IH N D OW", ["WIHN", "DOW"]),
        ("AE T L AH S", ["AET", "LAHS"]),
        ("IH N S T R AH M AH N T", ["IHN", "STRAH", "MAHNT"]),
        ("S T R EH NG TH S", ["STREHNGTHS"]),
        ("IY AH", ["IY", "AH"]),
        ("L AY T _ B AH L B", ["LAYT_", "BAHLB"]),
        ("m œ ç t ə", ["mœç", "tə"]),
    ],
)
def test_cases(word, expected) -> None:
    assert syllables(word) == expected


def test_words_are_not_joined() -> None:
    assert syllables("AE T", "AO L") == ["AET", "AOL"]
