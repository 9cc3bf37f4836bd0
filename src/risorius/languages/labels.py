"""How corpora and forced aligners write phones in labels (`data/labels.toml`), as ARPAbet or IPA."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache, cached_property

from ..errors import InputError
from ..reading.toml import package_text, parse
from .phones import inventory

TABLE = "labels.toml"
_BRACKETS = ("<>", "[]", "{}")
# Kaldi's names tell where in its word a phone stands: begin, inside, end, single.
_POSITION = re.compile(r"_[BIES]$")
_STRESS = {'"': "ˈ", "%": "ˌ"}


@dataclass(frozen=True)
class LabelTable:
    """The file: labels of silence and noise, other spellings of ARPAbet, and SAMPA's symbols as IPA."""

    silence: tuple[str, ...]
    unknown_word: tuple[str, ...]
    noise: tuple[str, ...]
    arpabet: Mapping[str, str]
    closure: Mapping[str, str]
    sampa: Mapping[str, str]

    @cached_property
    def quiet_words(self) -> frozenset[str]:
        """Labels of silence in tiers of words."""
        return frozenset((*self.silence, *self.unknown_word))

    @cached_property
    def quiet_phones(self) -> frozenset[str]:
        """Labels of silence and noise in tiers of phones."""
        return self.quiet_words.union(self.noise)

    def ipa_of_sampa(self, label: str) -> str | None:
        """Return a label in SAMPA or X-SAMPA as IPA; None if it is not that."""
        stress, found = "", ""
        while label[:1] in _STRESS:
            stress, label = stress or _STRESS[label[0]], label[1:]
        while label:
            length = next((n for n in range(self._longest, 0, -1) if label[:n] in self.sampa), 0)
            if not length:
                return None
            found, label = found + self.sampa[label[:length]], label[length:]
        return stress + found if found else None

    @cached_property
    def _longest(self) -> int:
        return max(map(len, self.sampa))


@cache
def label_table() -> LabelTable:
    """Return the package's table; raise InputError if a row names a phone that the inventory lacks."""
    table = parse(LabelTable, package_text(__package__, TABLE), TABLE)
    phones = {symbol for symbol, _ in inventory().rows()}
    for symbol in (*table.arpabet.values(), *table.closure.values()):
        if symbol not in phones:
            raise InputError(f"{TABLE}: '{symbol}' is not a phone of the inventory")
    return table


def without_position(label: str) -> str:
    """Return a label without Kaldi's mark of the phone's place in its word."""
    return _POSITION.sub("", label.strip())


def is_quiet_word(text: str) -> bool:
    """Tell whether a label in a tier of words stands for silence or noise."""
    plain = text.strip()
    return plain.lower() in label_table().quiet_words or _is_bracketed(plain)


def is_quiet_phone(text: str) -> bool:
    """Tell whether a label in a tier of phones stands for silence or noise."""
    plain = without_position(text)
    return plain.lower() in label_table().quiet_phones or _is_bracketed(plain)


def _is_bracketed(label: str) -> bool:
    """Tell whether something stands between brackets, which begin and end the label."""
    return len(label) > len("[]") and label[0] + label[-1] in _BRACKETS
