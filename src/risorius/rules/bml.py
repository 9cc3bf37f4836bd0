"""The meanings of BML's words (`data/bml.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from ..core.action_units import resolve_targets
from ..core.units import BehaviourSeconds, SignedShare
from .load import load


@dataclass(frozen=True, slots=True)
class Heading:
    """Shares of an angle: up, and to the subject's left."""

    pitch: SignedShare
    yaw: SignedShare


@dataclass(frozen=True, slots=True)
class Lengths:
    """Seconds that behaviours last."""

    face: BehaviourSeconds
    gaze: BehaviourSeconds


@dataclass(frozen=True, slots=True)
class BmlTable:
    """Action units by lexeme, directions by name, the head's share by influence, durations."""

    lexeme: Mapping[str, Mapping[str, float]]
    direction: Mapping[str, Heading]
    influence: Mapping[str, SignedShare]
    duration: Lengths

    def __post_init__(self) -> None:
        for units in self.lexeme.values():
            resolve_targets(units)


@cache
def bml_table() -> BmlTable:
    """Return the package's table."""
    return load(BmlTable, "bml.toml")
