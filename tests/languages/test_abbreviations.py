"""Abbreviations: which full stops end a sentence."""

from __future__ import annotations

import pytest

from risorius.languages import language_of
from risorius.languages.abbreviations import ends_sentence
from risorius.languages.abbreviations import is_abbreviation as is_one_of


def is_abbreviation(text: str, stop: int, code: str = "en") -> bool:
    language = language_of(code)
    return is_one_of(text, stop, language.abbreviations, language.function_words)


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        ("Mr. Smith", True),
        ("Mr.", True),
        ("St. Paul", True),
        ("J. Smith", True),
        ("etc. and", True),
        ("etc. And", False),
        ("etc.", False),
        ("Jan. 5", True),
        ("No. 5", True),
        ("No. He", False),
        ("end. The", False),
        ("I. The", False),
        ("B. The", False),
        ("B. Bobson", True),
    ],
)
def test_abbreviations(text, is_one) -> None:
    assert is_abbreviation(text, text.index(".")) is is_one


@pytest.mark.parametrize(
    ("text", "is_one"), [("U.S. army", True), ("U.S. Army", True), ("U.S. He", False), ("U.S.", False)]
)
def test_acronyms(text, is_one) -> None:
    assert is_abbreviation(text, text.rindex(".")) is is_one


def test_far_into_a_text() -> None:
    text = "word " * 100 + "Mrs. Jones left. Then"
    assert is_abbreviation(text, text.index("Mrs.") + 3)
    assert not is_abbreviation(text, text.index("left.") + 4)


@pytest.mark.parametrize(
    ("rest", "ends"),
    [("", True), (" The", True), (' "The', True), (" the", False), ("The", False), (" 5", False)],
)
def test_what_follows_decides(rest, ends) -> None:
    assert ends_sentence(rest) is ends


@pytest.mark.parametrize(
    ("code", "text", "is_one"),
    [
        ("de", "am 3. Oktober", True),
        ("de", "Im Jahr 1990. Dann", False),
        ("en", "at 3. Then", False),
        ("de", "z. B. Peter", True),
        ("de", "usw. und", True),
        ("de", "usw. Dann", False),
        ("fr", "M. Dupont", True),
        ("es", "Sr. Pérez", True),
        ("it", "ecc. Poi", False),
        ("nl", "Mevr. Jansen", True),
        ("pt", "Sra. Silva", True),
        ("pl", "Mr. Kowalski", False),
    ],
)
def test_abbreviations_of_each_language(code: str, text: str, is_one: bool) -> None:
    assert is_abbreviation(text, text.index("."), code) is is_one
