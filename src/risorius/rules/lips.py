"""The lips' table: what each phone wants of the articulators, and how strongly (`data/lips.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Annotated

from ..core.action_units import resolve_targets
from ..core.movement import Dominance
from ..core.parameters import parameters_named
from ..core.schema import Range
from ..errors import InputError, unknown
from .load import load

Share = Annotated[float, Range(0.0, 1.0)]
Weights = Mapping[str, Annotated[float, Range(0.0, 100.0)]]
EVERYTHING = "*"


@dataclass(frozen=True, slots=True)
class PhoneShape:
    """One phone: its class, its articulators' targets 0..1, and how much of it a contact holds."""

    lip_class: str = field(metadata={"key": "class"})
    targets: Mapping[str, Share]
    closure: Share = 1.0


@dataclass(frozen=True, slots=True)
class LipClass:
    """A class of phones: dominance magnitude per articulator, flanks in seconds, limits per parameter."""

    magnitude: Weights
    before: Annotated[float, Range(0.001, 1.0)]
    after: Annotated[float, Range(0.001, 1.0)]
    limits: Mapping[str, tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Diphthong:
    """Two shapes in a row; `turn` is the share of the phone that the first one takes."""

    parts: tuple[str, str]
    turn: Share


@dataclass(frozen=True, slots=True)
class Opening:
    """How stress, position, the voice and pauses change the opening; seconds and factors."""

    stressed: float
    unstressed: float
    phrase_final: float
    prominence: Annotated[float, Range(0.0, 0.15)]
    most_prominent: Annotated[float, Range(0.0, 3.0)]
    shortest_pause: Annotated[float, Range(0.0, 5.0)]
    breath_lead: Annotated[float, Range(0.0, 5.0)]
    breath_shape: Mapping[str, Share]


@dataclass(frozen=True, slots=True)
class _File:
    articulators: Mapping[str, Mapping[str, Share]]
    classes: Mapping[str, LipClass] = field(metadata={"key": "class"})
    phones: Mapping[str, PhoneShape] = field(metadata={"key": "phone"})
    diphthongs: Mapping[str, Diphthong] = field(metadata={"key": "diphthong"})
    opening: Opening


@dataclass(frozen=True, slots=True)
class Holding:
    """What all phones of a class share: dominance and limits per parameter, both sides spelled out."""

    dominance: Mapping[str, Dominance]
    limits: Mapping[str, tuple[float, float]]


@dataclass(frozen=True, slots=True)
class LipTable:
    """The lips' rules, ready for use: phones by ARPAbet symbol, classes by name."""

    articulators: Mapping[str, Mapping[str, float]]
    holdings: Mapping[str, Holding]
    phones: Mapping[str, PhoneShape]
    diphthongs: Mapping[str, Diphthong]
    opening: Opening
    rest: PhoneShape = field(default_factory=lambda: PhoneShape("silence", {}))

    def shape(self, symbol: str) -> PhoneShape:
        """Return a phone's shape; raise InputError for a phone that the table does not have."""
        try:
            return self.phones[symbol]
        except KeyError:
            raise InputError(unknown("phone", symbol, (*self.phones, *self.diphthongs))) from None

    def shapes(self, symbol: str) -> tuple[tuple[str, PhoneShape, float], ...]:
        """Return a phone's shapes in order, each with its symbol and share of the phone's time."""
        diphthong = self.diphthongs.get(symbol)
        if diphthong is None:
            return ((symbol, self.shape(symbol), 1.0),)
        first, second = (self.shape(part) for part in diphthong.parts)
        return (symbol, first, diphthong.turn), (symbol, second, 1.0 - diphthong.turn)

    def to_parameters(self, articulators: Mapping[str, float]) -> Mapping[str, float]:
        """Return the parameters that perform `articulators` (values 0..1); shares of one parameter add up."""
        total: dict[str, float] = {}
        for name, value in articulators.items():
            for base, weight in self.articulators[name].items():
                total[base] = min(total.get(base, 0.0) + weight * value, 1.0)
        return MappingProxyType(resolve_targets(total))


@lru_cache(maxsize=1)
def lip_table() -> LipTable:
    """Return the package's table; raise InputError if its names do not fit together."""
    raw = load(_File, "lips.toml")
    _check_names(raw)
    holdings = {name: _holding(raw, lip_class) for name, lip_class in raw.classes.items()}
    return LipTable(raw.articulators, holdings, raw.phones, raw.diphthongs, raw.opening)


def _holding(raw: _File, lip_class: LipClass) -> Holding:
    dominance: dict[str, Dominance] = {}
    for articulator, magnitude in lip_class.magnitude.items():
        held = Dominance(magnitude, lip_class.before, lip_class.after)
        if articulator == EVERYTHING:
            dominance[EVERYTHING] = held
            continue
        for base in raw.articulators[articulator]:
            dominance |= {p.name: held for p in parameters_named(base)}
    limits = {p.name: span for base, span in lip_class.limits.items() for p in parameters_named(base)}
    return Holding(MappingProxyType(dominance), MappingProxyType(limits))


def _check_names(raw: _File) -> None:
    used: list[tuple[str, str, Mapping[str, object]]] = []
    used += [(name, "articulator", raw.articulators) for c in raw.classes.values() for name in c.magnitude]
    used += [(name, "articulator", raw.articulators) for p in raw.phones.values() for name in p.targets]
    used += [(name, "articulator", raw.articulators) for name in raw.opening.breath_shape]
    used += [(p.lip_class, "class of phones", raw.classes) for p in raw.phones.values()]
    used += [(part, "phone", raw.phones) for d in raw.diphthongs.values() for part in d.parts]
    for name, kind, known in used:
        if name != EVERYTHING and name not in known:
            raise InputError(f"lips.toml: {unknown(kind, name, known)}")
