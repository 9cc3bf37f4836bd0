"""Phone sets: ARPAbet and the International Phonetic Alphabet (IPA).

ARPAbet is English: the phones of the inventory (`phones.py`), without stress digits. `from_ipa` knows the
sounds of the IPA chart and gives each the ARPAbet phone that looks nearest on the lips. What even that does
not know is given by class (`UNKNOWN_VOWEL`, `UNKNOWN_CONSONANT`) and marked.
"""

from __future__ import annotations

import unicodedata
from typing import NamedTuple

from .phones import PhoneManner, inventory


class PhonePart(NamedTuple):
    """One ARPAbet phone and the share (0..1) that it takes of the time of the sound it is a part of."""

    phone: str
    share: float


class ArpabetReading(NamedTuple):
    """The ARPAbet parts of a foreign symbol; `known` is False if only the class of the sound was known."""

    parts: tuple[PhonePart, ...]
    known: bool


VOWEL_IPA = {symbol: row.ipa for symbol, row in inventory().vowel.items()}
CONSONANT_IPA = {symbol: row.ipa for symbol, row in inventory().consonant.items()}
VOWELS = frozenset(VOWEL_IPA)
CONSONANTS = frozenset(CONSONANT_IPA)
ARPABET = VOWELS | CONSONANTS
IPA = VOWEL_IPA | CONSONANT_IPA
_CLOSED = (PhoneManner.STOP, PhoneManner.AFFRICATE)
STOPS = inventory().made(*_CLOSED)
VOICELESS_STOPS = inventory().made(*_CLOSED, voiced=False)
NASALS = inventory().made(PhoneManner.NASAL)

UNKNOWN_VOWEL = "AH"
UNKNOWN_CONSONANT = "T"
STRESS_MARKS = {"'": 2, ",": 1, "ˈ": 2, "ˌ": 1}


def strip_stress(name: str) -> tuple[str, int]:
    """Split a mnemonic or IPA name into the bare name and its stress: 2 primary, 1 secondary, 0 none."""
    stress = 0
    while name and (name[0] in STRESS_MARKS or name[0] in "%="):
        stress = max(stress, STRESS_MARKS.get(name[0], 0))
        name = name[1:]
    return name.removeprefix("!"), stress


# The IPA chart and what looks nearest to it on the lips. Longer symbols are matched first.
_FROM_IPA: dict[str, tuple[str, ...]] = {
    **{ipa: (phone,) for phone, ipa in IPA.items()},
    # open and central vowels
    "a": ("AA",), "ɐ": ("AH",), "ɒ": ("AA",), "ə": ("AH",), "ɘ": ("AH",), "ɜ": ("AH",), "ɤ": ("AH",),
    "ɚ": ("ER",), "ɜː": ("ER",), "ɞ": ("AO",), "ɶ": ("AA",), "ɪ̈": ("IH",), "ᵻ": ("IH",), "ɨ": ("IH",),
    "e": ("EH",), "eː": ("EY",), "æː": ("AE",), "ʏ": ("UH",), "y": ("UW",), "ɯ": ("IH",), "ʉ": ("UW",),
    "ᵿ": ("UH",), "o": ("OW",), "ø": ("UH",), "œ": ("UH",), "ɵ": ("UH",),
    # diphthongs written otherwise
    "aj": ("AY",), "ai": ("AY",), "au": ("AW",), "ɑu": ("AW",), "ɑʊ": ("AW",), "ɔi": ("OY",), "ɔø": ("OY",),
    "ɔʏ": ("OY",), "ei": ("EY",), "ɛɪ": ("EY",), "əʊ": ("OW",), "ou": ("OW",), "əl": ("AH", "L"),
    "ɪɹ": ("IH", "R"), "ɛɹ": ("EH", "R"), "ʊɹ": ("UH", "R"), "ɑːɹ": ("AA", "R"), "ɔːɹ": ("AO", "R"),
    "aɪɚ": ("AY", "ER"), "aʊɚ": ("AW", "ER"), "iə": ("IY", "AH"), "ɪə": ("IH", "AH"), "eə": ("EH", "AH"),
    "ʊə": ("UH", "AH"), "aɪə": ("AY", "AH"), "aʊə": ("AW", "AH"),
    # consonants: lips, tongue tip, blade, back, throat
    "ɓ": ("B",), "β": ("V",), "ɸ": ("F",), "ʋ": ("V",), "ⱱ": ("V",), "ɱ": ("M",), "ʍ": ("W",), "ɥ": ("W",),
    "pf": ("P", "F"), "ʈ": ("T",), "ɖ": ("D",), "ɗ": ("D",), "ɾ": ("D",), "ɽ": ("D",), "ts": ("T", "S"),
    "dz": ("D", "Z"), "ɬ": ("L",), "ɮ": ("L",), "ɫ": ("L",), "ɭ": ("L",), "ʎ": ("L",), "ʟ": ("L",),
    "r": ("R",), "ɻ": ("R",), "ʀ": ("HH",), "ʁ": ("HH",), "ɳ": ("N",), "ɲ": ("N",), "ɴ": ("NG",),
    "ʂ": ("SH",), "ʐ": ("ZH",), "ɕ": ("SH",), "ʑ": ("ZH",), "tɕ": ("CH",), "dʑ": ("JH",), "ʧ": ("CH",),
    "ʤ": ("JH",), "c": ("K",), "ɟ": ("G",), "ç": ("HH",), "ʝ": ("Y",), "g": ("G",), "q": ("K",), "ɢ": ("G",),
    "x": ("HH",), "ɣ": ("G",), "χ": ("HH",), "ɰ": ("G",), "ħ": ("HH",), "ʕ": ("HH",), "ɦ": ("HH",),
    "ʔ": ("HH",),
}  # fmt: skip
_LONGEST = max(map(len, _FROM_IPA))
# Tie bars, and the hyphen by which espeak-ng marks a variant.
_IGNORED = dict.fromkeys(map(ord, "\u0361\u035c-"))
_VOWEL_LETTERS = frozenset("aeiouyæøœɶɑɒɔəɘɛɜɞɐɪɨᵻɯɤɵʉʊᵿʌʏɚɝ")
_STOP_LETTERS = frozenset("pbtdkɡgcɟqɢʈɖɓɗɠʛʔʧʤ")
_NASAL_LETTERS = frozenset("mɱnɳɲŋɴ")
_VOICELESS_LETTERS = frozenset("ptkcqʈʧ")


def is_ipa_vowel(symbol: str) -> bool:
    """Tell whether an IPA symbol is a vowel or diphthong, or a consonant that is a syllable by itself."""
    plain = unicodedata.normalize("NFD", symbol)
    return any(char in _VOWEL_LETTERS for char in plain) or "\u0329" in plain


def is_vowel(symbol: str) -> bool:
    """Tell whether a phone (ARPAbet or IPA) is a vowel; silence is not."""
    return symbol in VOWELS if symbol in ARPABET else is_ipa_vowel(symbol)


def is_stop(symbol: str) -> bool:
    """Tell whether a phone (ARPAbet or IPA) begins with a closure: plosives and affricates."""
    return symbol in STOPS if symbol in ARPABET else symbol[:1] in _STOP_LETTERS


def is_voiceless_stop(symbol: str) -> bool:
    """Tell whether a phone (ARPAbet or IPA) begins with a silent closure."""
    return symbol in VOICELESS_STOPS if symbol in ARPABET else symbol[:1] in _VOICELESS_LETTERS


def is_nasal(symbol: str) -> bool:
    """Tell whether a phone (ARPAbet or IPA) is a nasal consonant."""
    return symbol in NASALS if symbol in ARPABET else symbol[:1] in _NASAL_LETTERS


def from_ipa(symbol: str) -> ArpabetReading:
    """Return the ARPAbet nearest to an IPA symbol of any language, for instance "ɔːɹ", "ts" or "yː".

    Length, tone, nasality and secondary articulation are dropped unless a longer symbol names them. Parts
    share the time evenly but for the first, a vowel or closure, which takes 0.6. No parts: nothing audible.
    """
    text = unicodedata.normalize("NFD", symbol).replace("c\u0327", "\u00e7").translate(_IGNORED)
    phones: list[str] = []
    known = True
    while text:
        found = next((n for n in range(min(_LONGEST, len(text)), 0, -1) if text[:n] in _FROM_IPA), 0)
        if found:
            phones += _FROM_IPA[text[:found]]
        elif text[0].isalpha() and unicodedata.category(text[0]) != "Lm":
            phones.append(UNKNOWN_VOWEL if text[0] in _VOWEL_LETTERS else UNKNOWN_CONSONANT)
            known = False
        text = text[max(found, 1) :]
    return ArpabetReading(_shared(phones), known)


def _shared(phones: list[str]) -> tuple[PhonePart, ...]:
    if len(phones) < 2:
        return tuple(PhonePart(phone, 1.0) for phone in phones)
    rest = 0.4 / (len(phones) - 1)
    return tuple(PhonePart(phone, 0.6 if i == 0 else rest) for i, phone in enumerate(phones))


def to_arpabet(symbol: str) -> tuple[str, ...]:
    """Return the ARPAbet phones of a phone that is ARPAbet already, or IPA; none for silence."""
    if symbol in ARPABET:
        return (symbol,)
    return tuple(part.phone for part in from_ipa(symbol).parts)
