"""Accents: content words, on their stressed syllable; one nucleus per phrase."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.speech.accents import is_content_word
from risorius.speech.english import function_words
from risorius.speech.synthesis import synthesize


def accented(text: str, engine) -> list[str]:
    """Return the accented words, nuclei in capitals."""
    said = synthesize(text, engine=engine)
    return [
        said.words[a.word].text.upper() if a.nuclear else said.words[a.word].text.lower()
        for a in said.accents
    ]


@pytest.mark.parametrize("word", ["the", "The", "OF", "it’s", "it's", "and"])
def test_function_words(word) -> None:
    assert not is_content_word(word)


@pytest.mark.parametrize("word", ["map", "very", "oh", "schön"])
def test_content_words(word) -> None:
    assert is_content_word(word)


def test_the_list_is_lower_case_without_comments() -> None:
    assert all(word == word.lower() and word.replace("'", "").isalpha() for word in function_words())


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("My baby brother put the map by the beam.", ["baby", "brother", "map", "BEAM"]),
        ("Oh, really? I like it very much.", ["OH", "REALLY", "very", "MUCH"]),
        ("The cat sat, the dog ran.", ["cat", "SAT", "dog", "RAN"]),
    ],
)
def test_cases(text, expected, engine) -> None:
    assert accented(text, engine) == expected


def test_a_phrase_without_content_words_has_an_accent_all_the_same(engine) -> None:
    said = synthesize("Is it?", engine=engine)
    assert [(a.nuclear, a.confidence) for a in said.accents] == [(True, 0.5)]


WORDS = st.sampled_from(["map,", "the", "Bob.", "of", "banana", "is;", "really?", "a"])


@given(st.lists(WORDS, min_size=1, max_size=10))
def test_accents_are_in_order_inside_their_syllables(words) -> None:
    said = synthesize(" ".join(words))
    assert [a.time for a in said.accents] == sorted(a.time for a in said.accents)
    for accent in said.accents:
        syllable = said.syllables[accent.syllable]
        assert syllable.start < accent.time < syllable.end
        assert syllable.word == accent.word
        assert accent.label == "*"
        assert 0 < accent.confidence <= 1
    assert said.accents[-1].nuclear
