"""The inventory of ARPAbet's phones (`data/phones.toml`): which there are, their IPA, manner and voice.

Tables with values per phone, wherever they stand, are checked against it (`check_phones`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

from ..errors import InputError
from ..reading.frozen import FrozenDict
from ..reading.toml import package_text, parse

INVENTORY = "phones.toml"


class PhoneManner(StrEnum):
    """The articulation of a phone."""

    VOWEL = "vowel"
    RHOTIC = "rhotic"
    LATERAL = "lateral"
    GLIDE = "glide"
    STOP = "stop"
    AFFRICATE = "affricate"
    SIBILANT = "sibilant"
    FRICATIVE = "fricative"
    ASPIRATE = "aspirate"
    NASAL = "nasal"


class SoundClass(StrEnum):
    """Classes of phones that sound alike at their edges: manners, some divided by voice."""

    VOWEL = "vowel"
    RHOTIC = "rhotic"
    LATERAL = "lateral"
    GLIDE = "glide"
    VOICELESS_STOP = "voiceless_stop"
    VOICED_STOP = "voiced_stop"
    AFFRICATE = "affricate"
    SIBILANT = "sibilant"
    VOICELESS_FRICATIVE = "voiceless_fricative"
    VOICED_FRICATIVE = "voiced_fricative"
    ASPIRATE = "aspirate"
    NASAL = "nasal"
    SILENCE = "silence"


_DIVIDED_BY_VOICE = (PhoneManner.STOP, PhoneManner.FRICATIVE)


@dataclass(frozen=True, slots=True)
class VowelRow:
    """A vowel: its IPA, and its manner if it is not a vowel's alone."""

    ipa: str
    manner: PhoneManner = PhoneManner.VOWEL
    voiced: bool = True


@dataclass(frozen=True, slots=True)
class ConsonantRow:
    """A consonant: its IPA, its manner, and whether the vocal folds vibrate."""

    ipa: str
    manner: PhoneManner
    voiced: bool


@dataclass(frozen=True, slots=True)
class PhoneInventory:
    """The file: vowels and consonants by their ARPAbet symbols."""

    vowel: Mapping[str, VowelRow]
    consonant: Mapping[str, ConsonantRow]

    def rows(self) -> Iterator[tuple[str, VowelRow | ConsonantRow]]:
        """Yield all phones with their rows, vowels first."""
        yield from self.vowel.items()
        yield from self.consonant.items()

    def made(self, *manners: PhoneManner, voiced: bool | None = None) -> frozenset[str]:
        """Return the phones of some manners, either voiced, or voiceless, or both (None)."""
        fitting = ((symbol, row) for symbol, row in self.rows() if row.manner in manners)
        return frozenset(symbol for symbol, row in fitting if voiced in (None, row.voiced))

    def sound_classes(self) -> Mapping[str, SoundClass]:
        """Return the class of every phone's sound, "" being silence."""
        classes = {symbol: _sound_class(row.manner, row.voiced) for symbol, row in self.rows()}
        return FrozenDict({**classes, "": SoundClass.SILENCE})


def _sound_class(manner: PhoneManner, voiced: bool) -> SoundClass:
    if manner in _DIVIDED_BY_VOICE:
        return SoundClass(f"{'voiced' if voiced else 'voiceless'}_{manner}")
    return SoundClass(manner)


@cache
def inventory() -> PhoneInventory:
    """Return the package's inventory."""
    return parse(PhoneInventory, package_text(__package__, INVENTORY), INVENTORY)


def check_phones(table: str, symbols: Iterable[str]) -> None:
    """Raise InputError if a table's rows, by ARPAbet symbol, lack a phone of the inventory."""
    symbol_set = {*symbols}
    lacking = [phone for phone, _ in inventory().rows() if phone not in symbol_set]
    if lacking:
        plural = "s" if len(lacking) > 1 else ""
        raise InputError(
            f"{table} lacks the phone{plural} {', '.join(lacking)}; expected a row for each of {INVENTORY}"
        )
