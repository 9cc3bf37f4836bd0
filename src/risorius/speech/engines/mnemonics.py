"""espeak-ng's names of sounds: its mnemonics as ARPAbet and back, and its variant of IPA as IPA."""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence

from ...languages import Language
from ...languages.phonesets import (
    ARPABET,
    UNKNOWN_CONSONANT,
    UNKNOWN_VOWEL,
    VOWELS,
    ArpabetReading,
    PhonePart,
    from_ipa,
    strip_stress,
)

# Mnemonics of r, before which some vowels lose their second part.
_R_NAMES = frozenset({"r", "r-", "r/"})
# Transitions without a target of their own; they lengthen the sound before them.
_TRANSITIONS = frozenset({";", ":", "-", "||", ""})
# How the mnemonics of vowels and of consonants that are vowels by class begin.
_VOWEL_LETTERS = frozenset("@aeiouAEIOUVYW0123&")
# Variants of a sound are marked with ASCII signs.
_VARIANT_SIGNS = "-.+"
# ARPAbet's digits of stress as espeak-ng's marks: primary, secondary, none.
_MARKS = {"1": "'", "2": ",", "0": ""}
_DIGIT = {2: "1", 1: "2", 0: "0"}


def is_pause(name: str) -> bool:
    """Tell whether a mnemonic names a pause (`_:`, `_`, `_!`, `_|` …)."""
    return name.startswith("_")


def from_mnemonic(name: str, following: str, language: Language) -> ArpabetReading:
    """Return the ARPAbet of a mnemonic (bare, without stress) before the one `following`.

    No parts: the name has no sound of its own, and the sound before it lasts through it.
    """
    table = language.mnemonics
    if name in _TRANSITIONS:
        return ArpabetReading((), True)
    if name in table.before_r and following in _R_NAMES:
        return ArpabetReading((PhonePart(table.before_r[name], 1.0),), True)
    if name in table.simple:
        return ArpabetReading((PhonePart(table.simple[name], 1.0),), True)
    if name in table.compound:
        return ArpabetReading(tuple(PhonePart(*part) for part in table.compound[name]), True)
    phone = UNKNOWN_VOWEL if name[:1] in _VOWEL_LETTERS else UNKNOWN_CONSONANT
    return ArpabetReading((PhonePart(phone, 1.0),), False)


def as_ipa(name: str, language: Language) -> str:
    """Return the IPA of a sound that espeak-ng calls `name`, without stress."""
    plain = unicodedata.normalize("NFC", name)
    return language.spellings.get(plain) or name.strip(_VARIANT_SIGNS)


def dictated(phones: Sequence[str], language: Language) -> str | None:
    """Return espeak-ng's spelling of phones, ARPAbet with stress digits or IPA with stress marks.

    None if phones cannot be dictated to a voice of the language.
    """
    if not language.mnemonics.dictated:
        return None
    return "".join(_mnemonic(part, language) for phone in phones for part in to_arpabet(phone))


def to_arpabet(phone: str) -> tuple[str, ...]:
    """Return a phone as ARPAbet, vowels with a stress digit; no stress digit on ARPAbet means none."""
    bare, digit = (phone[:-1], phone[-1]) if phone[-1:] in _MARKS else (phone, "0")
    if bare in ARPABET:
        return (bare + digit if bare in VOWELS else bare,)
    name, stress = strip_stress(phone)
    parts = [part.phone for part in from_ipa(name).parts]
    return tuple(part + _DIGIT[stress] if part in VOWELS else part for part in parts)


def _mnemonic(phone: str, language: Language) -> str:
    table = language.mnemonics
    bare, digit = (phone[:-1], phone[-1]) if phone[-1] in _MARKS else (phone, "")
    if digit == "0":
        return table.unstressed.get(bare, table.dictated[bare])
    return _MARKS.get(digit, "") + table.dictated[bare]
