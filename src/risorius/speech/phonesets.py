"""Phone sets: ARPAbet, the International Phonetic Alphabet (IPA), and espeak-ng's English mnemonics.

ARPAbet is the 39 phones of the CMU dictionary, without stress digits. Anything else comes to it in one of two
ways: espeak-ng's American mnemonics through a complete table (`from_mnemonic`), IPA of any language through
`from_ipa`, which knows the sounds of the IPA chart and gives each the ARPAbet phone that looks nearest on
the lips. What even that does not know is given by class (`UNKNOWN_VOWEL`, `UNKNOWN_CONSONANT`) and marked.
"""

from __future__ import annotations

import unicodedata
from typing import NamedTuple


class Part(NamedTuple):
    """One ARPAbet phone and the share (0..1) that it takes of the time of the sound it is a part of."""

    phone: str
    share: float


class Reading(NamedTuple):
    """The ARPAbet parts of a foreign symbol; `known` is False where only the class of the sound was known."""

    parts: tuple[Part, ...]
    known: bool


# ARPAbet and its IPA, after the CMU dictionary's key.
VOWEL_IPA = {
    "AA": "ɑ", "AE": "æ", "AH": "ʌ", "AO": "ɔ", "AW": "aʊ", "AY": "aɪ", "EH": "ɛ", "ER": "ɝ", "EY": "eɪ",
    "IH": "ɪ", "IY": "i", "OW": "oʊ", "OY": "ɔɪ", "UH": "ʊ", "UW": "u",
}  # fmt: skip
CONSONANT_IPA = {
    "B": "b", "CH": "tʃ", "D": "d", "DH": "ð", "F": "f", "G": "ɡ", "HH": "h", "JH": "dʒ", "K": "k", "L": "l",
    "M": "m", "N": "n", "NG": "ŋ", "P": "p", "R": "ɹ", "S": "s", "SH": "ʃ", "T": "t", "TH": "θ", "V": "v",
    "W": "w", "Y": "j", "Z": "z", "ZH": "ʒ",
}  # fmt: skip
VOWELS = frozenset(VOWEL_IPA)
CONSONANTS = frozenset(CONSONANT_IPA)
ARPABET = VOWELS | CONSONANTS
IPA = VOWEL_IPA | CONSONANT_IPA
VOICELESS_STOPS = frozenset({"P", "T", "K", "CH"})
NASALS = frozenset({"M", "N", "NG"})
STOPS = VOICELESS_STOPS | {"B", "D", "G", "JH"}

UNKNOWN_VOWEL = "AH"
UNKNOWN_CONSONANT = "T"
STRESS_MARKS = {"'": 2, ",": 1, "ˈ": 2, "ˌ": 1}

# espeak-ng's mnemonics of its English tables (`en-us` and what it inherits), as sounds of American English.
_SIMPLE = {
    "@": "AH", "@-": "AH", "@2": "AH", "@5": "UH", "@#": "AH", "a": "AE", "aa": "AE", "a2": "AE", "a:": "AE",
    "a#": "AH", "a#2": "AH", "A:": "AA", "A#": "AA", "A~": "AA", "0": "AA", "0#": "AA", "02": "AA",
    "O": "AO", "O:": "AO", "O2": "AO", "O~": "AO", "V": "AH", "VR": "ER", "IR": "ER", "3": "ER", "3:": "ER",
    "E": "EH", "E#": "EH", "E2": "EH", "e": "EY", "e:": "EY", "e#": "AH", "I": "IH", "I#": "IH", "I2": "IH",
    "I2#": "IH", "i": "IY", "i:": "IY", "o": "OW", "o:": "OW", "U": "UH", "u": "UW", "u:": "UW", "aI": "AY",
    "aU": "AW", "eI": "EY", "OI": "OY", "oU": "OW", "oU#": "OW",
    "b": "B", "tS": "CH", "tS;": "CH", "d": "D", "d[": "D", "d#": "D", "D": "DH", "f": "F", "g": "G",
    "h": "HH", "C": "HH", "x": "K", "X": "HH", "dZ": "JH", "dZ;": "JH", "k": "K", "c": "K", "q": "K",
    "J": "G", "l": "L", "l/": "L", "l/2": "L", "l/3": "L", "l#": "L", "l.": "L", "L": "L", "L/": "L",
    "m": "M", "n": "N", "n.": "N", "N": "NG", "p": "P", "B": "V", "r": "R", "r-": "R", "r/": "R", "r.": "R",
    "R": "R", "R2": "R", "R3": "R", "**": "R", "*": "D", "s": "S", "s;": "S", "s.": "SH", "S": "SH",
    "S;": "SH", "t": "T", "t[": "T", "t2": "T", "?": "T", "T": "TH", "t#": "D", "v": "V", "v#": "V",
    "w": "W", "w#": "W", "j": "Y", "z": "Z", "z#": "Z", "z/2": "Z", "z;": "Z", "z.": "ZH", "Z": "ZH",
    "Z;": "ZH", "Q": "G", "Q^": "G", "Q\"": "R", "r\"": "R",
}  # fmt: skip
_COMPOUND = {
    "@L": (("AH", 0.45), ("L", 0.55)), "l-": (("AH", 0.3), ("L", 0.7)), "m-": (("AH", 0.3), ("M", 0.7)),
    "n-": (("AH", 0.3), ("N", 0.7)), "N-": (("AH", 0.3), ("NG", 0.7)),
    "A@": (("AA", 0.6), ("R", 0.4)), "O@": (("AO", 0.6), ("R", 0.4)), "o@": (("AO", 0.6), ("R", 0.4)),
    "e@": (("EH", 0.55), ("R", 0.45)), "U@": (("UH", 0.5), ("R", 0.5)), "i@3": (("IH", 0.5), ("R", 0.5)),
    "i@": (("IY", 0.55), ("AH", 0.45)), "aI@": (("AY", 0.65), ("AH", 0.35)),
    "aI3": (("AY", 0.6), ("ER", 0.4)), "aU@": (("AW", 0.6), ("ER", 0.4)),
    "l^": (("L", 0.6), ("Y", 0.4)), "n^": (("N", 0.6), ("Y", 0.4)), "J^": (("Y", 1.0),),
}  # fmt: skip
# Before another r these lose their second part: "era", "caring", "tour of".
_BEFORE_R = {
    "A@": "AA", "O@": "AO", "o@": "AO", "e@": "EH", "U@": "UH", "i@": "IH", "i@3": "IH", "aI3": "AY",
    "aU@": "AW",
}  # fmt: skip
_R_NAMES = frozenset({"r", "r-", "r/"})
# Transitions without a target of their own; they lengthen the sound before them.
_TRANSITIONS = frozenset({";", ":", "-", "||", ""})


def strip_stress(name: str) -> tuple[str, int]:
    """Split a mnemonic or IPA name into the bare name and its stress: 2 primary, 1 secondary, 0 none."""
    stress = 0
    while name and (name[0] in STRESS_MARKS or name[0] in "%="):
        stress = max(stress, STRESS_MARKS.get(name[0], 0))
        name = name[1:]
    return name.removeprefix("!"), stress


def is_pause(name: str) -> bool:
    """Tell whether a mnemonic names a pause (`_:`, `_`, `_!`, `_|` …)."""
    return name.startswith("_")


def from_mnemonic(name: str, following: str = "") -> Reading:
    """Return the ARPAbet of an American English mnemonic (bare, without stress) before the one `following`.

    No parts: the name has no sound of its own, and the sound before it lasts through it.
    """
    if name in _TRANSITIONS:
        return Reading((), True)
    if name in _BEFORE_R and following in _R_NAMES:
        return Reading((Part(_BEFORE_R[name], 1.0),), True)
    if name in _SIMPLE:
        return Reading((Part(_SIMPLE[name], 1.0),), True)
    if name in _COMPOUND:
        return Reading(tuple(Part(*part) for part in _COMPOUND[name]), True)
    return Reading((Part(_by_class(name), 1.0),), False)


def _by_class(name: str) -> str:
    return UNKNOWN_VOWEL if name[:1] in set("@aeiouAEIOUVYW0123&") else UNKNOWN_CONSONANT


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
    """Tell whether a phone (ARPAbet or IPA) is a vowel; silence is none."""
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


def from_ipa(symbol: str) -> Reading:
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
    return Reading(_shared(phones), known)


def _shared(phones: list[str]) -> tuple[Part, ...]:
    if len(phones) < 2:
        return tuple(Part(phone, 1.0) for phone in phones)
    rest = 0.4 / (len(phones) - 1)
    return tuple(Part(phone, 0.6 if i == 0 else rest) for i, phone in enumerate(phones))


def to_arpabet(symbol: str) -> tuple[str, ...]:
    """Return the ARPAbet phones of a phone that is ARPAbet already, or IPA; none for silence."""
    if symbol in ARPABET:
        return (symbol,)
    return tuple(part.phone for part in from_ipa(symbol).parts)
