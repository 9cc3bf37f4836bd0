"""The speed of the eyes: the main sequence of saccades (`saccade.toml`)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from ..core.units import RiseSeconds
from .load import load


@dataclass(frozen=True, slots=True)
class Saccade:
    """The table `saccade.toml`: seconds = latency + per_degree · degrees."""

    latency: RiseSeconds
    per_degree: RiseSeconds


@cache
def saccade_table() -> Saccade:
    """Return the package's table."""
    return load(Saccade, "saccade.toml")


def saccade_duration(degrees: float) -> float:
    """Return how many seconds the eyes take for a turn of `degrees` (facts: science/03, section 3.3)."""
    table = saccade_table()
    return table.latency + table.per_degree * abs(degrees)
