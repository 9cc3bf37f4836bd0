"""What the lips give up where neighbouring phones leave no time for all of it (`data/sacrifice.toml`)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Annotated

from ..core.schema import Range
from ..core.toml import parse
from ..core.units import ContactSeconds, GapMillimetres, Share
from ..errors import InputError, unknown

NAME = "sacrifice.toml"
DEMANDS = ("opening", "rounding", "tuck", "seal")


@dataclass(frozen=True, slots=True)
class Opening:
    """How far lips open between closures: `fastest` mm/s, `gentle` seconds, `rounded` mm."""

    source: str
    fastest: Annotated[float, Range(20.0, 1000.0)]
    gentle: ContactSeconds
    rounded: GapMillimetres


@dataclass(frozen=True, slots=True)
class Rounding:
    """What is `kept` of a neighbour's width and protrusion while the lower lip is at the teeth, 0..1."""

    source: str
    kept: Share


@dataclass(frozen=True, slots=True)
class Tuck:
    """How the lower lip makes room for closures, seconds; the lips' `gap` while it is at the teeth, mm.

    `waits`: the share of its contact that it leaves to a rounded phone beside it, on either side.
    """

    source: str
    gap: GapMillimetres
    ramp: ContactSeconds
    waits: Annotated[float, Range(0.0, 0.5)]
    least_room: ContactSeconds


@dataclass(frozen=True, slots=True)
class Seal:
    """The closure of the lips, seconds."""

    source: str
    ramp: ContactSeconds
    shortest: ContactSeconds


@dataclass(frozen=True, slots=True)
class Sacrifice:
    """The order in which demands give way, first to last, and by how much each may."""

    order: tuple[str, ...]
    opening: Opening
    rounding: Rounding
    tuck: Tuck
    seal: Seal

    def before(self, demand: str, other: str) -> bool:
        """Return whether a demand gives way to another."""
        return self.order.index(demand) < self.order.index(other)


@lru_cache(maxsize=1)
def sacrifice() -> Sacrifice:
    """Return the package's table."""
    text = (resources.files(__package__) / "data" / NAME).read_text(encoding="utf-8")
    return checked(parse(Sacrifice, text, NAME))


def checked(table: Sacrifice) -> Sacrifice:
    """Return the table; raise InputError unless its order names each demand once, with the closure last."""
    for name in table.order:
        if name not in DEMANDS:
            raise InputError(f"{NAME}: {unknown('demand', name, DEMANDS)}")
    if sorted(table.order) != sorted(DEMANDS) or table.order[-1] != DEMANDS[-1]:
        raise InputError(
            f"{NAME}: order is {list(table.order)}; expected each of {list(DEMANDS)} once, and last "
            f"'{DEMANDS[-1]}', which never gives way"
        )
    return table
