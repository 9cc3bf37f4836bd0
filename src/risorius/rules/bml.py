"""What BML's words stand for (`data/bml.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated

from ..core.action_units import resolve_targets
from ..core.schema import Range
from .load import load

Share = Annotated[float, Range(-1.0, 1.0)]
Seconds = Annotated[float, Range(0.1, 60.0)]


@dataclass(frozen=True, slots=True)
class Heading:
    """Shares of an angle: up, and to the subject's left."""

    pitch: Share
    yaw: Share


@dataclass(frozen=True, slots=True)
class Lengths:
    """Seconds that behaviours last."""

    face: Seconds
    gaze: Seconds


@dataclass(frozen=True, slots=True)
class BmlTable:
    """Action units by lexeme, directions by name, the head's share by influence, durations."""

    lexeme: Mapping[str, Mapping[str, float]]
    direction: Mapping[str, Heading]
    influence: Mapping[str, Share]
    duration: Lengths

    def __post_init__(self) -> None:
        for units in self.lexeme.values():
            resolve_targets(units)


@cache
def bml_table() -> BmlTable:
    """Return the package's table."""
    return load(BmlTable, "bml.toml")
