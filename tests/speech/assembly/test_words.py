"""Phones go to the words of the text, also where the engine's words are others."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.languages import language_of
from risorius.speech.assembly.words import assign, split
from risorius.speech.text.normalise import normalise
from risorius.speech.text.tokens import tokenize

SYMBOLS = st.sampled_from(["AH", "IH", "T", "DH", "N", "V"])


@pytest.mark.parametrize(
    ("phones", "words", "expected"),
    [
        ("AH V DH AH", ["AH V", "DH AH"], [2, 2]),
        ("IH N DH IH", ["IH N", "DH AH"], [2, 2]),
        ("HH AH V B IH N", ["HH AE V", "B IH N"], [3, 3]),
        ("DH AE T DH AH", ["DH AE T", "DH AH"], [3, 2]),
        ("W UH D AH V B IH N", ["W UH D", "HH AE V", "B IY N"], [3, 2, 3]),
        ("G AA N AH", ["G OW IH NG", "T UW"], [3, 1]),
        ("T", ["T UW", "B IY"], [1, 0]),
        ("T AH B", ["T AH B"], [3]),
        ("", ["T UW", "B IY"], [0, 0]),
    ],
)
def test_shared_phones_are_split_as_the_words_are_said(phones, words, expected) -> None:
    assert split(phones.split(), [word.split() for word in words]) == expected


@given(
    st.lists(SYMBOLS, max_size=12),
    st.lists(st.lists(SYMBOLS, min_size=1, max_size=4), min_size=1, max_size=5),
)
def test_a_split_uses_every_phone_and_starves_no_word(phones, words) -> None:
    counts = split(phones, words)
    assert sum(counts) == len(phones)
    assert len(counts) == len(words)
    assert min(counts) >= (1 if len(phones) >= len(words) else 0)


@given(st.lists(st.lists(SYMBOLS, min_size=1, max_size=4), min_size=1, max_size=4))
def test_words_said_as_transcribed_are_split_exactly(words) -> None:
    counts = split([symbol for word in words for symbol in word], words)
    assert sum(counts) == sum(map(len, words))
    assert len(words) > 1 or counts == [len(words[0])]


def assigned(text: str, phones: list[tuple[str, int]], said: dict[str, str]) -> list[str]:
    tokens = tokenize(text)
    owners = assign(
        [symbol for symbol, _ in phones],
        [position for _, position in phones],
        normalise(text, 0, len(text), language_of("en")),
        tokens,
        lambda words: [said.get(word, "").split() for word in words],
    )
    return [tokens[owner].text for owner in owners]


def test_tokens_without_a_place_share_that_of_the_one_before() -> None:
    phones = [("AH", 0), ("V", 0), ("DH", 0), ("AH", 0), ("M", 7), ("AE", 7), ("P", 7)]
    said = {"of": "AH V", "the": "DH AH", "map": "M AE P"}
    assert assigned("of the map", phones, said) == ["of", "of", "the", "the", "map", "map", "map"]


def test_a_token_that_is_not_said_gets_nothing() -> None:
    phones = [("AH", 0), ("N", 4), ("OW", 4)]
    assert assigned("uh @ no", phones, {"uh": "AH", "@": ""}) == ["uh", "no", "no"]


def test_many_words_of_a_number_are_one_token() -> None:
    phones = [("W", 0), ("AH", 0), ("N", 0), ("T", 1), ("UW", 0), ("M", 4)]
    assert assigned("1,24 m", phones, {}) == ["1,24"] * 5 + ["m"]


def test_positions_beside_a_token_or_beyond_the_text() -> None:
    assert assigned("- a b.", [("AH", 0), ("B", 3), ("T", 99), ("T", -1)], {}) == ["a", "b", "b", "b"]


def test_phones_without_any_token_are_refused() -> None:
    with pytest.raises(ValueError, match="without a token"):
        assign(["AH"], [0], normalise("!", 0, 1, language_of("en")), (), lambda _: [])
