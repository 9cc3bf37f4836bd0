"""Transcriptions in attributes: IPA and ARPAbet."""

from __future__ import annotations

import re
import unicodedata

from ..errors import InputError, ParameterError, unknown
from ..rules.articulation import articulation
from ..rules.lips import lip_table
from .elements import Attribute
from .quote import one_line

_STRESS = "ˈˌ"
# The second part of English diphthongs.
_GLIDES = "ɪʊ"


def read_ipa(attribute: Attribute) -> tuple[str, ...]:
    """Return the phones of an IPA transcription, stress marks on the vowel that follows them.

    Raises ParameterError, with the place, for a sound that is not known.
    """
    phones: list[str] = []
    stress = ""
    table = articulation()
    for part in re.split(rf"([{_STRESS}])|[\s.‿|]+", unicodedata.normalize("NFD", attribute.value)):
        if not part:
            continue
        if part in _STRESS:
            stress = part
            continue
        try:
            for letter, marks in table.letters(part):
                vowel = letter in table.vowel
                if letter in _GLIDES and not stress and phones and phones[-1][-1] in table.vowel:
                    phones[-1] += letter + marks
                    continue
                phones.append((stress if vowel else "") + letter + marks)
                stress = "" if vowel else stress
        except ParameterError as error:
            raise error.at(attribute.place) from None
    if not phones:
        raise InputError(f"{attribute.name} has no phones; expected e.g. həˈləʊ", attribute.place)
    return tuple(phones)


def read_arpabet(attribute: Attribute) -> tuple[str, ...]:
    """Return phones of ARPAbet between blanks; raise ParameterError, with the place, for an unknown one."""
    table = lip_table()
    phones = tuple(attribute.value.upper().split())
    for phone in phones:
        if phone.rstrip("012") not in (*table.phones, *table.diphthongs):
            known = (*table.phones, *table.diphthongs)
            raise ParameterError(unknown("phone", one_line(phone), known), attribute.place)
    if not phones:
        raise InputError(f"{attribute.name} has no phones; expected e.g. HH AH0 L OW1", attribute.place)
    return phones
