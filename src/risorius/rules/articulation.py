"""Sounds of any language by their articulatory features (`data/articulation.toml`)."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from ..core.lips.articulators import PROTRUSION, within_range
from ..core.units import Share
from ..errors import InputError, ParameterError, unknown
from ..languages.phones import check_phones
from ..languages.phonesets import IPA
from ..reading.frozen import FrozenDict
from .lips import LipTargets, PhoneShape, check_shape, lip_table
from .load import load

TABLE = "articulation.toml"


@dataclass(frozen=True, slots=True)
class Consonant:
    """The place and manner of a consonant."""

    place: str
    manner: str


@dataclass(frozen=True, slots=True)
class ArticulationRow:
    """The lips for consonants of a place and, if given, a manner: as for an English phone or a lip class."""

    place: str
    manner: str | None = None
    like: str | None = None
    lip_class: str | None = field(default=None, metadata={"key": "class"})
    targets: LipTargets = field(default_factory=FrozenDict)

    def __post_init__(self) -> None:
        if (self.like is None) == (self.lip_class is None):
            raise InputError(f"{self.place}: expected either 'like' or 'class'")


@dataclass(frozen=True, slots=True)
class Unseen:
    """Marks that do not change the lips: letters, and the first and last of a block of combining marks."""

    letters: str
    combining: tuple[str, str]


@dataclass(frozen=True, slots=True)
class Corner:
    """A corner of the vowels' space."""

    targets: LipTargets


@dataclass(frozen=True, slots=True)
class Limits:
    """The rounding from which a vowel counts as rounded; the share of a diphthong for its first vowel."""

    rounded: Share
    turn: Share


class SpeechSound(NamedTuple):
    """One sound of a symbol, its lips, and the share (0..1) of the symbol's time."""

    symbol: str
    shape: PhoneShape
    share: float


@dataclass(frozen=True, slots=True)
class Articulation:
    """The table `articulation.toml`. Raises InputError if its names do not fit those of the lips."""

    vowel: Mapping[str, tuple[Share, Share, Share]]
    consonant: Mapping[str, Consonant]
    lips: tuple[ArticulationRow, ...]
    mark: Mapping[str, LipTargets]
    unseen: Unseen
    close_front: Corner
    open_front: Corner
    close_back: Corner
    open_back: Corner
    close_round: Corner
    open_round: Corner
    limits: Limits

    def __post_init__(self) -> None:
        table = lip_table()
        for row in self.lips:
            if row.like is not None:
                table.shape(row.like)
            elif row.lip_class not in table.holdings:
                raise InputError(unknown("class of phones", str(row.lip_class), table.holdings))
        corners = (self.close_front, self.open_front, self.close_back, self.open_back)
        target_sets = [shape.targets for shape in (*corners, self.close_round, self.open_round)]
        for targets in (*target_sets, *(row.targets for row in self.lips)):
            check_shape(targets)
        for letter, consonant in self.consonant.items():
            if self._row(consonant) is None:
                raise InputError(f"{letter}: no row of 'lips' fits {consonant.place} {consonant.manner}")

    def sounds(self, symbol: str) -> tuple[SpeechSound, ...]:
        """Return the sounds that an IPA symbol holds, in order; raise ParameterError for unknown letters."""
        parsed = [(letter, self._marked(letter, marks)) for letter, marks in self.letters(symbol)]
        if not parsed:
            raise ParameterError(f"'{symbol}' holds no sound; expected a phone in IPA")
        shares = self._shares([letter for letter, _ in parsed])
        return tuple(SpeechSound(n, shape, share) for (n, shape), share in zip(parsed, shares, strict=True))

    def letters(self, symbol: str) -> Iterator[tuple[str, str]]:
        """Yield the letters of an IPA symbol, each with the marks after it.

        Raises ParameterError for a character that is neither a letter nor a mark of the table.
        """
        text = unicodedata.normalize("NFD", symbol).replace("c\u0327", "ç").translate(_TIES)
        at = 0
        while at < len(text):
            size = next((n for n in (2, 1) if self.is_letter(text[at : at + n])), 0)
            if not size and not self._is_mark(text[at]):
                raise ParameterError(unknown("phone", symbol, (*self.vowel, *self.consonant)))
            end = at + max(size, 1)
            while end < len(text) and self._is_mark(text[end]):
                end += 1
            if size:
                yield text[at : at + size], text[at + size : end]
            at = end

    def has(self, symbol: str) -> bool:
        """Tell whether all letters of an IPA symbol are in the table."""
        try:
            return any(True for _ in self.letters(symbol))
        except ParameterError:
            return False

    def is_letter(self, text: str) -> bool:
        """Tell whether `text` is one letter, or two that are one sound."""
        return text in self.vowel or text in self.consonant

    def _is_mark(self, char: str) -> bool:
        first, last = self.unseen.combining
        return char in self.mark or char in self.unseen.letters or first <= char <= last

    def _marked(self, letter: str, marks: str) -> PhoneShape:
        shape = self._vowel(letter) if letter in self.vowel else self._consonant(self.consonant[letter])
        added = [self.mark[char] for char in marks if char in self.mark]
        if not added:
            return shape
        return PhoneShape(shape.lip_class, _sum([shape.targets, *added]), shape.closure)

    def _vowel(self, letter: str) -> PhoneShape:
        height, backness, rounding = self.vowel[letter]
        front = _between(self.close_front.targets, self.open_front.targets, height)
        back = _between(self.close_back.targets, self.open_back.targets, height)
        rounded = _between(self.close_round.targets, self.open_round.targets, height)
        targets = _between(_between(front, back, backness), rounded, rounding)
        if rounding < self.limits.rounded:
            return PhoneShape("vowel", {n: v for n, v in targets.items() if n != PROTRUSION})
        return PhoneShape("rounded_vowel", targets)

    def _consonant(self, consonant: Consonant) -> PhoneShape:
        row = self._row(consonant)
        assert row is not None
        if row.like is not None:
            return lip_table().shape(row.like)
        return PhoneShape(str(row.lip_class), row.targets)

    def _row(self, consonant: Consonant) -> ArticulationRow | None:
        fitting = (r for r in self.lips if r.place == consonant.place)
        return next((r for r in fitting if r.manner in (None, consonant.manner)), None)

    def _shares(self, letters: list[str]) -> list[float]:
        """Return each sound's share: glides are half as long as others, a diphthong turns at `turn`."""
        weights = [1.0 if letter in self.vowel else 0.5 for letter in letters]
        for index, (a, b) in enumerate(pairwise(letters)):
            if a in self.vowel and b in self.vowel:
                weights[index] *= self.limits.turn / (1.0 - self.limits.turn)
        return [weight / sum(weights) for weight in weights]


# Tie bars join two letters to one sound; the hyphen is espeak-ng's mark of a variant.
_TIES = dict.fromkeys(map(ord, "\u0361\u035c-"))


def _between(a: LipTargets, b: LipTargets, share: float) -> dict[str, float]:
    names = dict.fromkeys((*a, *b))
    return {n: (1.0 - share) * a.get(n, 0.0) + share * b.get(n, 0.0) for n in names}


def _sum(parts: list[LipTargets]) -> dict[str, float]:
    total: dict[str, float] = {}
    for part in parts:
        for name, value in part.items():
            total[name] = total.get(name, 0.0) + value
    return {name: within_range(name, value) for name, value in total.items()}


@cache
def articulation() -> Articulation:
    """Return the package's table; raise InputError if it lacks a phone."""
    table = load(Articulation, TABLE)
    check_phones(TABLE, (phone for phone, ipa in IPA.items() if table.has(ipa)))
    return table


@cache
def sounds(symbol: str) -> tuple[SpeechSound, ...]:
    """Return the sounds of a phone: ARPAbet as in the lips' table, IPA by features; share of its time each.

    Raises ParameterError for a phone that is neither.
    """
    table = lip_table()
    if symbol in table.phones or symbol in table.diphthongs:
        return tuple(SpeechSound(*part) for part in table.shapes(symbol))
    return articulation().sounds(symbol)


def is_known(symbol: str) -> bool:
    """Tell whether a phone's lips are known."""
    try:
        sounds(symbol)
    except ParameterError:
        return False
    return True
