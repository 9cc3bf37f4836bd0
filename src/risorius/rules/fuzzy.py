"""From intensities of emotions to contractions, by fuzzy rules (`fuzzy.toml`; after Bui et al. 2001)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache

from ..core.action_units import resolve_targets, unit_weights
from ..core.parameters import INDEX, PARAMETERS, RIVALS
from ..core.units import Share
from ..errors import InputError
from .emotions import emotion
from .fuzzy_sets import check_centres, concluded
from .load import load

Shares = tuple[Share, Share, Share, Share, Share]
Centres = tuple[float, float, float, float, float]
UPPER = ("brows", "lids")


@dataclass(frozen=True, slots=True)
class Keeps:
    """An emotion's shares of the upper and the lower face, by how much stronger than the other it is."""

    upper: Shares
    lower: Shares


@dataclass(frozen=True, slots=True)
class EmotionPair:
    """Two emotions, and the shares that each keeps beside the other."""

    one: str
    other: str
    upper: Shares
    lower: Shares
    other_upper: Shares
    other_lower: Shares

    def __post_init__(self) -> None:
        if emotion(self.one) is emotion(self.other):
            raise InputError(f"{self.one} is paired with itself; expected two emotions")


@dataclass(frozen=True, slots=True)
class FuzzyTable:
    """The table `fuzzy.toml`."""

    difference: Centres
    default: Keeps
    pair: tuple[EmotionPair, ...]

    def __post_init__(self) -> None:
        check_centres(self.difference)

    def keeps(self, name: str, other: str) -> Keeps:
        """Return the rules for the shares that an emotion keeps beside another."""
        for pair in self.pair:
            if (pair.one, pair.other) == (name, other):
                return Keeps(pair.upper, pair.lower)
            if (pair.other, pair.one) == (name, other):
                return Keeps(pair.other_upper, pair.other_lower)
        return self.default


@cache
def fuzzy_table() -> FuzzyTable:
    """Return the package's table."""
    return load(FuzzyTable, "fuzzy.toml")


def blend_units(name: str, company: Mapping[str, float]) -> dict[str, float]:
    """Return the units and muscles of an emotion among emotions with intensities 0..1, itself one of them.

    The strongest of several others counts. Continuous in all intensities; rising in its own, falling in the
    other's where the rules' shares do.
    """
    own = company[name]
    targets = emotion(name).shown_units(own)
    others = {n: i for n, i in company.items() if n != name}
    if not others:
        return targets
    other = max(others, key=lambda n: (others[n], n))
    return dict(_kept(targets, fuzzy_table(), name, other, own - others[other], others[other]))


def shown_units(name: str, company: Mapping[str, float]) -> dict[str, float]:
    """Return what an emotion shows in a layer of its own beside others: `blend_units` without weaker rivals.

    A unit with a muscle that gives way to a rival of another emotion is replaced by its other muscles.
    """
    units = blend_units(name, company)
    if len(company) == 1:
        return units
    together = blended(company)
    yielding = {
        muscle for muscle, value in resolve_targets(units).items() if value and muscle not in together
    }
    split = {unit: value for unit, value in units.items() if yielding & resolve_targets({unit: value}).keys()}
    left = {muscle: value for muscle, value in resolve_targets(split).items() if muscle not in yielding}
    return {unit: value for unit, value in units.items() if unit not in split} | left


def _kept(
    targets: Mapping[str, float], table: FuzzyTable, name: str, other: str, difference: float, strength: float
) -> Iterator[tuple[str, float]]:
    keeps = table.keeps(name, other)
    upper, lower = (concluded(difference, table.difference, s) for s in (keeps.upper, keeps.lower))
    for target, value in targets.items():
        share = upper if _is_upper(target) else lower
        # A weak emotion takes little away from the other.
        yield target, value * (1.0 - strength * (1.0 - share))


def _is_upper(target: str) -> bool:
    """Tell whether a parameter, or the muscle that a unit contracts most, is in the upper face."""
    weights = unit_weights(target)
    name = max(weights, key=weights.__getitem__) if weights else target
    return PARAMETERS[INDEX[name]].group in UPPER


def blended(company: Mapping[str, float]) -> dict[str, float]:
    """Return the values of emotions displayed together: of each parameter the one furthest from rest.

    Of two rivals that different emotions contract the weaker stays at rest (paper A, section 2: a channel
    holds only movements that do not conflict); what one contracts together, as in a tense face, it keeps.
    """
    total: dict[str, float] = {}
    shown = [resolve_targets(blend_units(name, company)) for name in company]
    for targets in shown:
        for parameter, value in targets.items():
            total[parameter] = max(total.get(parameter, 0.0), value, key=abs)
    for parameter in sorted(total, key=lambda name: -abs(total[name])):
        for rival in RIVALS[parameter]:
            together = any(targets.get(parameter) and targets.get(rival) for targets in shown)
            if total.get(parameter) and total.get(rival) and not together:
                total[rival] = 0.0
    return {p.name: total[p.name] for p in PARAMETERS if total.get(p.name)}
