"""Phones dictated to espeak-ng: ARPAbet and IPA as its mnemonics."""

from __future__ import annotations

from collections.abc import Sequence

from .. import phonesets
from ..text.normalise import is_english

# ARPAbet as espeak-ng's American voice spells it.
_ENGLISH = {
    "AA": "A:", "AE": "a", "AH": "V", "AO": "O:", "AW": "aU", "AY": "aI", "EH": "E", "ER": "3:", "EY": "eI",
    "IH": "I", "IY": "i:", "OW": "oU", "OY": "OI", "UH": "U", "UW": "u:",
    "B": "b", "CH": "tS", "D": "d", "DH": "D", "F": "f", "G": "g", "HH": "h", "JH": "dZ", "K": "k", "L": "l",
    "M": "m", "N": "n", "NG": "N", "P": "p", "R": "r", "S": "s", "SH": "S", "T": "t", "TH": "T", "V": "v",
    "W": "w", "Y": "j", "Z": "z", "ZH": "Z",
}  # fmt: skip
_UNSTRESSED = {"AH": "@", "ER": "3", "IY": "i"}
# ARPAbet's digits of stress as espeak-ng's marks: primary, secondary, none.
_MARKS = {"1": "'", "2": ",", "0": ""}
_DIGIT = {2: "1", 1: "2", 0: "0"}


def mnemonics(phones: Sequence[str], language: str) -> str | None:
    """Return espeak-ng's spelling of phones, ARPAbet with stress digits or IPA with stress marks.

    None where the language's mnemonics are not known: only English can be dictated.
    """
    if not is_english(language):
        return None
    return "".join(_mnemonic(part) for phone in phones for part in to_arpabet(phone))


def to_arpabet(phone: str) -> tuple[str, ...]:
    """Return a phone as ARPAbet, vowels with a stress digit; no stress digit on ARPAbet means none."""
    bare, digit = (phone[:-1], phone[-1]) if phone[-1:] in _MARKS else (phone, "0")
    if bare in phonesets.ARPABET:
        return (bare + digit if bare in phonesets.VOWELS else bare,)
    name, stress = phonesets.strip_stress(phone)
    parts = [part.phone for part in phonesets.from_ipa(name).parts]
    return tuple(part + _DIGIT[stress] if part in phonesets.VOWELS else part for part in parts)


def _mnemonic(phone: str) -> str:
    bare, digit = (phone[:-1], phone[-1]) if phone[-1] in _MARKS else (phone, "")
    if digit == "0":
        return _UNSTRESSED.get(bare, _ENGLISH[bare])
    return _MARKS.get(digit, "") + _ENGLISH[bare]
