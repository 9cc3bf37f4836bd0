"""The lips' trade-offs if neighbouring phones leave no time for everything (`data/tradeoffs.toml`)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Annotated

from ...core.units import ContactSeconds, GapMillimetres, Share
from ...errors import InputError, unknown
from ...reading.hints import Range
from ...reading.toml import parse

NAME = "tradeoffs.toml"
DEMANDS = ("opening", "rounding", "tuck", "seal")


@dataclass(frozen=True, slots=True)
class OpeningTradeoff:
    """Trade-off of the lips' opening between closures.

    `fastest`: their speed, mm/s; `gentle`: how long they take to reach it, seconds; `rounded`: the width over
    which an opening near the limit is rounded off, mm.
    """

    source: str
    fastest: Annotated[float, Range(20.0, 1000.0)]
    gentle: ContactSeconds
    rounded: GapMillimetres


@dataclass(frozen=True, slots=True)
class RoundingTradeoff:
    """The share of a neighbour's width and protrusion that remains while the lower lip touches the teeth.

    `remaining`: a share, 0..1.
    """

    source: str
    remaining: Share


@dataclass(frozen=True, slots=True)
class TuckTradeoff:
    """The room that the contact of the lower lip with the teeth leaves to closures and rounded phones.

    `gap`: the lips' gap during the contact, mm; `ramp`: how long the lip takes to reach or leave the teeth,
    seconds; `waits`: the share of the contact that a rounded phone may take on each side.
    """

    source: str
    gap: GapMillimetres
    ramp: ContactSeconds
    waits: Annotated[float, Range(0.0, 0.5)]


@dataclass(frozen=True, slots=True)
class SealTradeoff:
    """Seconds in which lips come to a closure that no articulators bring about, and seconds to leave it."""

    source: str
    ramp: ContactSeconds


@dataclass(frozen=True, slots=True)
class Tradeoffs:
    """The order in which demands give way, and by how much each may."""

    order: tuple[str, ...]
    opening: OpeningTradeoff
    rounding: RoundingTradeoff
    tuck: TuckTradeoff
    seal: SealTradeoff

    def before(self, demand: str, other: str) -> bool:
        """Return whether a demand gives way to another."""
        return self.order.index(demand) < self.order.index(other)


@lru_cache(maxsize=1)
def tradeoffs() -> Tradeoffs:
    """Return the package's table."""
    text = (resources.files(__package__) / "data" / NAME).read_text(encoding="utf-8")
    return checked(parse(Tradeoffs, text, NAME))


def checked(table: Tradeoffs) -> Tradeoffs:
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
