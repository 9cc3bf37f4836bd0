"""The meaning of a phone tier's labels: ARPAbet with or without stress digits, IPA, or silence."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from ...core.speech.utterance import SILENCE
from ...errors import InputError, Place, unknown
from ...languages import phonesets
from ...rules.articulation import is_known
from ...script.textgrid import Label

# How aligners and people write silence; "spn" is MFA's label for a word that it does not know.
SILENCES = frozenset(
    {"", "sil", "sp", "silence", "pau", "<p:>", "<eps>", "<sil>", "_", "#", "##", "h#", "ssil", "br"}
)
UNKNOWN_SOUNDS = frozenset({"spn", "nsn", "<unk>", "noise"})
# Variants of ARPAbet, and the phone of the CMU dictionary for each.
VARIANTS = {
    "AX": "AH",
    "AXR": "ER",
    "IX": "IH",
    "UX": "UW",
    "DX": "T",
    "NX": "N",
    "HV": "HH",
    "EL": "L",
    "EM": "M",
    "EN": "N",
}
_ARPABET = re.compile(r"([A-Za-z]{1,3})([0-2]?)")
# ARPAbet's digits to core's levels.
_LEVEL = {"0": 0, "1": 2, "2": 1}
UNSTRESSED = 0
TONE_LETTERS = "˥˦˧˨˩ˀ"


class PhoneLabel(NamedTuple):
    """A phone as core has it; `stress` None if the label does not tell."""

    symbol: str
    stress: int | None
    tone: str = ""


def read_phones(labels: Sequence[Label], source: str) -> tuple[bool, list[PhoneLabel]]:
    """Return whether the labels are ARPAbet (else IPA), and the meaning of each.

    Raises InputError, with the line, for a label that is not a phone.
    """
    spoken = [label for label in labels if not is_silence(label.text)]
    arpabet = all(_arpabet(label.text) for label in spoken)
    if not arpabet and _looks_arpabet(spoken):
        unknown_label = next(label for label in spoken if _arpabet(label.text) is None)
        known = sorted(phonesets.ARPABET)
        raise InputError(unknown("phone", unknown_label.text, known), Place(source, unknown_label.line))
    return arpabet, [_read(label, arpabet, source) for label in labels]


def is_silence(text: str) -> bool:
    """Tell whether a label stands for silence."""
    return text.strip().lower() in SILENCES | UNKNOWN_SOUNDS


def _read(label: Label, arpabet: bool, source: str) -> PhoneLabel:
    if is_silence(label.text):
        return PhoneLabel(SILENCE, -1)
    phone = _arpabet(label.text) if arpabet else _ipa(label.text)
    if phone is None:
        message = f"unknown phone {label.text!r}; expected ARPAbet or IPA"
        raise InputError(message, Place(source, label.line))
    return phone


def _arpabet(text: str) -> PhoneLabel | None:
    match = _ARPABET.fullmatch(text.strip())
    if match is None:
        return None
    symbol = VARIANTS.get(match[1].upper(), match[1].upper())
    if symbol not in phonesets.ARPABET:
        return None
    if not phonesets.is_vowel(symbol):
        return PhoneLabel(symbol, -1)
    return PhoneLabel(symbol, _LEVEL[match[2]] if match[2] else None)


def _ipa(text: str) -> PhoneLabel | None:
    toned, stress = phonesets.strip_stress(text.strip())
    bare = toned.rstrip(TONE_LETTERS)
    if not bare or not is_known(bare):
        return None
    marked, tone = toned != text.strip(), toned[len(bare) :]
    if not phonesets.is_vowel(bare):
        return PhoneLabel(bare, -1)
    return PhoneLabel(bare, stress if marked else None, tone)


def _looks_arpabet(labels: Sequence[Label]) -> bool:
    """Tell whether most labels are ARPAbet in capitals, so that one that is not is a slip."""
    known = sum(_arpabet(label.text) is not None and label.text[:1].isupper() for label in labels)
    return 2 * known > len(labels)
