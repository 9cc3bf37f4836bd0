"""Phonemes in DECtalk's notation."""

import pytest

from risorius.errors import InputError, Place
from risorius.rules.articulation import is_known
from risorius.script.dectalk import CODES, read_phonemes
from risorius.script.notation import Item

BAD = [
    ("jh@", "x:1:3: unknown phoneme '@'"),
    ("jh<6O>uw", "x:1:3: '<6O>' is not a duration; expected milliseconds"),
    ("jh<60", "x:1:3: '<60' is not a duration"),
    ("jh<0>", "x:1:3: '<0>' is not a duration"),
    ("jh<99999>", "x:1:3: '<99999>' is not a duration"),
    ("'p", "x:1:2: a stress mark before 'p', which is not a vowel"),
    ("p'", "x:1:3: unknown phoneme"),
]


def phones(text: str) -> list[str]:
    return [phone.symbol for phone in read_phonemes(Item(text, Place("x", 1, 1)))]


@pytest.mark.parametrize(("text", "message"), BAD)
def test_what_is_no_phoneme(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        phones(text)
    assert str(caught.value).startswith(message)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("p'aapkaorn", "P AA1 P K AO0 R N"),
        ("jh'uwliyax", "JH UW1 L IY0 AH0"),
        ("prixf'rrz", "P R IH0 F ER1 Z"),
        ("hxehl`ow", "HH EH0 L OW2"),
        ("myuzixk", "M Y UW0 Z IH0 K"),
        ('s"owl', "S OW1 L"),
        ("JH'UW", "JH UW1"),
    ],
)
def test_codes_run_together(text: str, expected: str) -> None:
    assert phones(text) == expected.split()


def test_durations_are_in_milliseconds_and_shared_by_what_is_two_sounds() -> None:
    found = read_phonemes(Item("l<50>'yu<200>_<300>", Place("x", 1, 1)))
    assert [(p.symbol, p.seconds) for p in found] == [("L", 0.05), ("Y", 0.1), ("UW1", 0.1), ("", 0.3)]


def test_every_code_has_lips() -> None:
    assert all(is_known(phone) for phones in CODES.values() for phone in phones)
