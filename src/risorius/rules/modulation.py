"""Modulation: factors on how often rules fire and how large their movements are.

Profiles, attitudes and emotions all modulate the rules so, never where or what the accents are (paper B,
3.2.1, 4.1 and 4.2).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Annotated

from ..reading.frozen import FrozenDict
from ..reading.hints import Range

ModulationFactor = Annotated[float, Range(0.0, 5.0)]


@dataclass(frozen=True, slots=True)
class Modulation:
    """Factors by rule id, or by its beginning up to a dot; those of several beginnings multiply."""

    rates: Mapping[str, ModulationFactor] = field(default_factory=FrozenDict)
    sizes: Mapping[str, ModulationFactor] = field(default_factory=FrozenDict)

    def at(self, intensity: float) -> Modulation:
        """Return the modulation at an intensity 0..1: at 0 nothing is changed."""
        return Modulation(
            *({k: 1.0 + intensity * (v - 1.0) for k, v in t.items()} for t in (self.rates, self.sizes))
        )

    def prefixes(self) -> frozenset[str]:
        """Return all ids and beginnings that it names."""
        return frozenset((*self.rates, *self.sizes))


def rate_of(name: str, modulations: Iterable[Modulation]) -> float:
    """Return the factor on how often the rule `name` fires."""
    return math.prod([_factor(name, modulation.rates) for modulation in modulations])


def size_of(name: str, modulations: Iterable[Modulation]) -> float:
    """Return the factor on how large the rule `name`'s movements are."""
    return math.prod([_factor(name, modulation.sizes) for modulation in modulations])


def _factor(name: str, factors: Mapping[str, float]) -> float:
    return math.prod([factors[start] for start in _beginnings(name) if start in factors]) if factors else 1.0


@cache
def _beginnings(name: str) -> tuple[str, ...]:
    """Return a rule's id and all its beginnings up to a dot, the shortest first."""
    parts = name.split(".")
    return tuple(".".join(parts[: i + 1]) for i in range(len(parts)))


def is_under(name: str, prefix: str) -> bool:
    """Tell whether a rule's id is `prefix` or begins with it up to a dot."""
    return name == prefix or name.startswith(prefix + ".")
