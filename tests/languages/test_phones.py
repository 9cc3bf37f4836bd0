"""The inventory of phones: what it lacks is refused, and every table with values per phone has all of it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from risorius.errors import InputError
from risorius.languages import phones
from risorius.languages.phones import PhoneInventory, PhoneManner, SoundClass, check_phones, inventory
from risorius.ports.speech.visemes import viseme_table
from risorius.reading.toml import parse
from risorius.rules.articulation import articulation
from risorius.rules.lips import lip_table

PHONES = (*inventory().vowel, *inventory().consonant)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[consonant]", "vowel"),
        ('[vowel]\nAA = { ipa = "ɑ", manner = "open" }\n[consonant]', "open"),
        ('[vowel]\n[consonant]\nP = { ipa = "p", manner = "stop" }', "voiced"),
        ('[vowel]\n[consonant]\nP = { ipa = "p", maner = "stop", voiced = false }', "maner"),
    ],
)
def test_an_inventory_that_lacks_something_is_refused(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse(PhoneInventory, text, "phones.toml")


def test_a_table_that_lacks_phones_is_named_in_one_line() -> None:
    with pytest.raises(InputError) as error:
        check_phones("lips.toml", [phone for phone in PHONES if phone not in ("ER", "B")])
    assert str(error.value) == "lips.toml lacks the phones ER, B; expected a row for each of phones.toml"
    check_phones("visemes.toml", [*PHONES, "O"])


@pytest.mark.parametrize(
    ("table", "name"),
    [
        (lip_table.__wrapped__, "lips.toml"),
        (articulation.__wrapped__, "articulation.toml"),
        (viseme_table.__wrapped__, "visemes.toml"),
    ],
)
def test_every_table_is_checked(
    table: Callable[[], object], name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    lip_table()
    more = {**inventory().vowel, "XX": phones.VowelRow("☃")}
    grown = PhoneInventory(more, inventory().consonant)
    monkeypatch.setattr(phones, "inventory", lambda: grown)
    monkeypatch.setattr("risorius.rules.articulation.IPA", {**dict.fromkeys(PHONES, "p"), "XX": "☃"})
    with pytest.raises(InputError, match=f"^{name} lacks the phone XX; expected a row"):
        table()


def test_phones_are_found_by_manner_and_voice() -> None:
    assert inventory().made(PhoneManner.AFFRICATE) == {"CH", "JH"}
    assert inventory().made(PhoneManner.STOP, voiced=False) == {"P", "T", "K"}
    assert inventory().made(PhoneManner.RHOTIC) == {"R", "ER"}


def test_every_phone_and_silence_has_a_class_of_sound_and_every_class_a_phone() -> None:
    classes = inventory().sound_classes()
    assert set(classes) == {*PHONES, ""}
    assert set(classes.values()) == set(SoundClass)
    assert classes["DH"] is SoundClass.VOICED_FRICATIVE
