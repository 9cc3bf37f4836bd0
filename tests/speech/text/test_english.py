"""English abbreviations: which full stops end a sentence."""

from __future__ import annotations

import pytest

from risorius.speech.text.english import ends_sentence, is_abbreviation


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
