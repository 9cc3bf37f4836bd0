"""espeak-ng's mnemonics: the table is complete, and nothing unknown crashes."""

from __future__ import annotations

from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.collected import all_cases

from risorius.languages import language_of
from risorius.languages.phonesets import ARPABET, ArpabetReading
from risorius.speech.engines.mnemonics import dictated, from_mnemonic
from risorius.speech.engines.protocol import SpeechRequest
from risorius.speech.engines.voices import find_voice

ENGLISH = language_of("en")
TABLE = ENGLISH.mnemonics
# Words whose sounds, together, are all that American English has.
EVERY_SOUND = (
    "beat bit bait bet bat father bought boat book boot but bird about bite bout boy sofa butter happy roses "
    "pie tie kite chew buy die guy jaw fee thigh see she vow thy zoo measure he my no sing lie ray way you "
    "car four air poor near fire hour bias idea button bottle bottom water little Bach the an or been were "
    "union unary additional answering anytime costs twelve albeit academia earring era sure Europe"
)


def parts(reading: ArpabetReading) -> list[str]:
    return [part.phone for part in reading.parts]


def test_a_language_without_mnemonics_takes_no_phones() -> None:
    assert dictated(["AH0"], language_of("de")) is None


def test_every_phone_can_be_dictated() -> None:
    assert set(TABLE.dictated) == ARPABET
    assert dictated(["HH", "AH0", "L", "OW1"], ENGLISH) == "h@l'oU"


def test_parts_are_arpabet_and_share_all_of_the_time() -> None:
    with all_cases() as case:
        for name, following in product({*TABLE.simple, *TABLE.compound}, ("", "r", "t")):
            reading = from_mnemonic(name, following, ENGLISH)
            with case(f"{name} before {following!r}"):
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
    assert parts(from_mnemonic(name, following, ENGLISH)) == expected


def test_every_sound_of_american_english_is_in_the_table(engine) -> None:
    rendition = engine.speak(SpeechRequest(EVERY_SOUND, find_voice("en-us", engine=engine)))
    assert rendition.guessed == ()
    assert {phone.symbol for phone in rendition.phones} - {""} == ARPABET


def test_an_unknown_mnemonic_is_given_by_its_class_and_marked() -> None:
    assert from_mnemonic("@@@", "", ENGLISH) == ((("AH", 1.0),), False)
    assert from_mnemonic("t!!", "", ENGLISH) == ((("T", 1.0),), False)


@given(st.text(max_size=8))
def test_no_name_crashes(name: str) -> None:
    assert set(parts(from_mnemonic(name, "", ENGLISH))) <= ARPABET
