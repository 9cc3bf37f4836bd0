"""Phone sets: the tables are complete and consistent, and nothing unknown crashes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.speech import phonesets
from risorius.speech.engines.protocol import SpeechRequest
from risorius.speech.engines.voices import find_voice
from risorius.speech.phonesets import ARPABET, from_ipa, from_mnemonic, strip_stress

# Words whose sounds, together, are all that American English has.
EVERY_SOUND = (
    "beat bit bait bet bat father bought boat book boot but bird about bite bout boy sofa butter happy roses "
    "pie tie kite chew buy die guy jaw fee thigh see she vow thy zoo measure he my no sing lie ray way you "
    "car four air poor near fire hour bias idea button bottle bottom water little Bach the an or been were "
    "union unary additional answering anytime costs twelve albeit academia earring era sure Europe"
)


def parts(reading: phonesets.Reading) -> list[str]:
    return [part.phone for part in reading.parts]


def test_the_sets_are_the_39_phones_of_arpabet() -> None:
    assert len(phonesets.VOWELS) == 15
    assert len(phonesets.CONSONANTS) == 24
    assert phonesets.STOPS <= phonesets.CONSONANTS
    assert {"P", "T", "K", "CH"} == phonesets.VOICELESS_STOPS


@pytest.mark.parametrize("phone", sorted(ARPABET))
def test_arpabet_survives_ipa_and_back(phone) -> None:
    assert parts(from_ipa(phonesets.IPA[phone])) == [phone]
    assert phonesets.to_arpabet(phone) == (phone,)


@pytest.mark.parametrize("phone", sorted(ARPABET))
def test_arpabet_and_its_ipa_are_of_the_same_class(phone) -> None:
    ipa = phonesets.IPA[phone]
    assert phonesets.is_vowel(ipa) == phonesets.is_vowel(phone) == (phone in phonesets.VOWELS)
    assert phonesets.is_stop(ipa) == phonesets.is_stop(phone)
    assert phonesets.is_voiceless_stop(ipa) == phonesets.is_voiceless_stop(phone)
    assert phonesets.is_nasal(ipa) == phonesets.is_nasal(phone)


@pytest.mark.parametrize("name", sorted({*phonesets._SIMPLE, *phonesets._COMPOUND}))
def test_parts_are_arpabet_and_share_all_of_the_time(name) -> None:
    for following in ("", "r", "t"):
        reading = from_mnemonic(name, following)
        assert reading.known
        assert set(parts(reading)) <= ARPABET
        assert sum(part.share for part in reading.parts) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("name", "following", "expected"),
    [
        ("A@", "t", ["AA", "R"]),
        ("A@", "r", ["AA"]),
        ("e@", "", ["EH", "R"]),
        ("i@", "l", ["IY", "AH"]),
        ("i@", "r", ["IH"]),
        ("aI3", "", ["AY", "ER"]),
        ("@L", "", ["AH", "L"]),
        ("t#", "@", ["D"]),
        (";", "", []),
    ],
)
def test_mnemonics_by_what_follows(name, following, expected) -> None:
    assert parts(from_mnemonic(name, following)) == expected


def test_every_sound_of_american_english_is_in_the_table(engine) -> None:
    rendition = engine.speak(SpeechRequest(EVERY_SOUND, find_voice("en-us", engine=engine)))
    assert rendition.guessed == ()
    assert {phone.symbol for phone in rendition.phones} - {""} == ARPABET


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
    assert from_mnemonic("@@@") == ((("AH", 1.0),), False)
    assert from_mnemonic("t!!") == ((("T", 1.0),), False)
    assert from_ipa("ǁ").known is False
    assert parts(from_ipa("ǁa")) == ["T", "AA"]


@given(st.text(max_size=8))
def test_no_symbol_crashes(symbol) -> None:
    for reading in (from_ipa(symbol), from_mnemonic(symbol)):
        assert set(parts(reading)) <= ARPABET
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
