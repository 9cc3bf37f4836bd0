"""Sounds of any language by their features."""

import pytest
from tests.collected import all_cases

from risorius.errors import InputError, ParameterError
from risorius.languages.phonesets import IPA, is_ipa_vowel
from risorius.rules.articulation import ArticulationRow, articulation, is_known, sounds
from risorius.rules.lips import lip_table

# How far the lips by features may be from the English table (0..1); schwa-like AH and OW differ most.
NEAR = 0.16


@pytest.mark.parametrize("symbol", ["", "ː", "3", "aB", "ʘ", "あ"])
def test_what_is_no_sound_is_an_error(symbol: str) -> None:
    assert not is_known(symbol)
    with pytest.raises(ParameterError, match=r"phone"):
        sounds(symbol)


@pytest.mark.parametrize("row", [{"place": "velar"}, {"place": "velar", "like": "K", "lip_class": "velar"}])
def test_a_row_says_like_or_class(row: dict[str, str]) -> None:
    with pytest.raises(InputError, match="either 'like' or 'class'"):
        ArticulationRow(**row)


def test_features_come_near_the_english_table() -> None:
    with all_cases() as case:
        # English writes [eɪ] and [oʊ] what the table opens more widely.
        for phone in IPA.keys() - {"EY", "OW"}:
            with case(phone):
                _check_features(phone)


def _check_features(phone: str) -> None:
    by_features, by_table = articulation().sounds(IPA[phone]), lip_table().shapes(phone)
    # English writes [i] and [u] what the table makes [ɪi] and [ʊu].
    by_table = by_table[-len(by_features) :]
    assert len(by_features) == len(by_table)
    for sound, (_, shape, _) in zip(by_features, by_table, strict=True):
        assert sound.shape.lip_class == shape.lip_class
        for name in ("jaw", "open", "round", "seal", "tuck"):
            assert sound.shape.targets.get(name, 0.0) == pytest.approx(shape.targets.get(name, 0.0), abs=NEAR)


@pytest.mark.parametrize(
    ("symbol", "letters"),
    [
        ("tɕʰ", ["tɕ"]),
        ("t͡s", ["ts"]),
        ("iau", ["i", "a", "u"]),
        ("œ̃", ["œ"]),
        ("ŋ̩", ["ŋ"]),
        ("ç", ["ç"]),
        ("ja", ["j", "a"]),
        ("sː", ["s"]),
        ("ə-", ["ə"]),
        ("M", ["M"]),
        ("AY", ["AY", "AY"]),
    ],
)
def test_symbols_hold_sounds(symbol: str, letters: list[str]) -> None:
    found = sounds(symbol)
    assert [sound.symbol for sound in found] == letters
    assert sum(sound.share for sound in found) == pytest.approx(1.0)


def test_rounding_shows_in_the_order_measured() -> None:
    rounds = [sounds(vowel)[0].shape.targets.get("round", 0.0) for vowel in "uyoɔaei"]
    assert rounds == sorted(rounds, reverse=True)
    assert rounds[4:] == [0.0, 0.0, 0.0]


def test_marks_change_the_lips_only_where_they_should() -> None:
    plain, rounded = sounds("k")[0].shape.targets, sounds("kʷ")[0].shape.targets
    assert rounded.get("lip_protrusion", 0.0) > plain.get("lip_protrusion", 0.0)
    for marked in ("kʰ", "k̃", "k̚"):
        assert sounds(marked)[0].shape == sounds("k")[0].shape
    assert sounds("ã")[0].shape == sounds("a˥")[0].shape == sounds("a")[0].shape


def test_every_vowel_of_the_table_is_one_for_syllables_too() -> None:
    for letter in articulation().vowel:
        assert is_ipa_vowel(letter), letter
    for letter in articulation().consonant:
        assert not is_ipa_vowel(letter), letter
