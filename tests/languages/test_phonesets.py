"""Phone sets: the tables are complete and consistent, and nothing unknown crashes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.collected import all_cases

from risorius.languages import phonesets
from risorius.languages.phonesets import ARPABET, from_ipa, strip_stress


def parts(reading: phonesets.ArpabetReading) -> list[str]:
    return [part.phone for part in reading.parts]


def test_the_sets_are_the_39_phones_of_arpabet() -> None:
    assert len(phonesets.VOWELS) == 15
    assert len(phonesets.CONSONANTS) == 24
    assert phonesets.STOPS <= phonesets.CONSONANTS
    assert {"P", "T", "K", "CH"} == phonesets.VOICELESS_STOPS


def test_arpabet_survives_ipa_and_back() -> None:
    with all_cases() as case:
        for phone, ipa in phonesets.IPA.items():
            with case(phone):
                assert parts(from_ipa(ipa)) == [phone]
                assert phonesets.to_arpabet(phone) == (phone,)


def test_arpabet_and_its_ipa_are_of_the_same_class() -> None:
    with all_cases() as case:
        for phone, ipa in phonesets.IPA.items():
            with case(phone):
                assert phonesets.is_vowel(ipa) == phonesets.is_vowel(phone) == (phone in phonesets.VOWELS)
                assert phonesets.is_stop(ipa) == phonesets.is_stop(phone)
                assert phonesets.is_voiceless_stop(ipa) == phonesets.is_voiceless_stop(phone)
                assert phonesets.is_nasal(ipa) == phonesets.is_nasal(phone)


@pytest.mark.parametrize(
    ("ipa", "expected"),
    [
        ("yː", ["UW"]),
        ("ç", ["HH"]),
        ("ts", ["T", "S"]),
        ("t͡ʃ", ["CH"]),
        ("ɔ̃", ["AO"]),
        ("dʲ", ["D"]),
        ("ɔːɹ", ["AO", "R"]),
        ("əl", ["AH", "L"]),
        ("kʰ", ["K"]),
        ("m̩", ["M"]),
        ("", []),
        ("ː", []),
        ("˥", []),
    ],
)
def test_ipa_of_other_languages(ipa, expected) -> None:
    reading = from_ipa(ipa)
    assert parts(reading) == expected
    assert reading.known


def test_an_unknown_sound_is_given_by_its_class_and_marked() -> None:
    assert from_ipa("ǁ").known is False
    assert parts(from_ipa("ǁa")) == ["T", "AA"]


@given(st.text(max_size=8))
def test_no_symbol_crashes(symbol) -> None:
    assert set(parts(from_ipa(symbol))) <= ARPABET
    assert phonesets.is_vowel(symbol) in (True, False)
    assert strip_stress(symbol)[1] in (0, 1, 2)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("'oU", ("oU", 2)),
        (",V", ("V", 1)),
        ("%I2", ("I2", 0)),
        ("''a", ("a", 2)),
        ("t", ("t", 0)),
        ("ˈɛ", ("ɛ", 2)),
        ("ˌɛ", ("ɛ", 1)),
    ],
)
def test_stress_is_a_prefix(name, expected) -> None:
    assert strip_stress(name) == expected
