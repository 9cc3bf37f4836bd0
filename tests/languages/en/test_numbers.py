"""How numbers may be said."""

from __future__ import annotations

import pytest

from risorius.languages.en.numbers import number_readings
from risorius.speech.alignment.lexicon import written_readings


@pytest.mark.parametrize("text", ["", "x", "1.5", "1,5", "12,34", "-3", "3rd", "\u0663", "1" * 13])
def test_what_is_no_whole_number_has_no_reading(text: str) -> None:
    assert number_readings(text) == ()


@pytest.mark.parametrize(
    ("text", "reading"),
    [
        ("0", "zero"),
        ("7", "seven"),
        ("42", "forty two"),
        ("105", "one hundred and five"),
        ("1,250", "one thousand two hundred fifty"),
        ("1005", "one thousand and five"),
        ("1984", "nineteen eighty four"),
        ("1905", "nineteen oh five"),
        ("1900", "nineteen hundred"),
        ("2024", "twenty twenty four"),
        ("2000", "two thousand"),
        ("007", "zero zero seven"),
        ("3000000", "three million"),
        ("999999999999", "nine hundred ninety nine billion nine hundred ninety nine million nine hundred "
         "ninety nine thousand nine hundred ninety nine"),
    ],
)  # fmt: skip
def test_readings(text: str, reading: str) -> None:
    assert reading in number_readings(text)


@pytest.mark.parametrize("text", ["42", "1984", "TV", "well-known", "the", "isn\u2019t"])
def test_written_words_are_read(text: str) -> None:
    assert written_readings(text)


def test_capitals_may_be_spelt_or_read() -> None:
    assert {("AH", "S"), ("Y", "UW", "EH", "S")} <= set(written_readings("US"))


def test_unknown_words_are_left_to_the_engine() -> None:
    assert written_readings("wraxlby") == ()
