"""The meanings of the markup's words: directions, gestures, turns and durations (`markup.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated

from ..core.action_units import resolve_targets
from ..core.movement import check_target
from ..core.units import MarkSeconds, Share, SignedShare
from ..reading.hints import Range
from .load import load

Swings = tuple[SignedShare, ...]


@dataclass(frozen=True, slots=True)
class Direction:
    """A direction of gaze in degrees: up and to the subject's left are positive."""

    pitch: Annotated[float, Range(-35.0, 35.0)]
    yaw: Annotated[float, Range(-45.0, 45.0)]

    @property
    def targets(self) -> dict[str, float]:
        """The parameters' values."""
        return {"gaze_pitch": self.pitch, "gaze_yaw": self.yaw}


@dataclass(frozen=True, slots=True)
class Gesture:
    """A repeated movement of one parameter: `swings` times `amplitude` degrees, `seconds` each.

    From one repetition to the next the amplitude is multiplied by `decay`.
    """

    parameter: str
    amplitude: Annotated[float, Range(0.0, 45.0)]
    swings: Swings
    seconds: MarkSeconds
    decay: Share

    def __post_init__(self) -> None:
        check_target(self.parameter, self.amplitude)


@dataclass(frozen=True, slots=True)
class TurnAttitude:
    """The direction of the eyes, and the other parameters' targets by action unit or name."""

    gaze: Direction
    targets: Mapping[str, float]

    def __post_init__(self) -> None:
        resolve_targets(self.targets)


@dataclass(frozen=True, slots=True)
class Durations:
    """Seconds that a mark lasts if it does not say."""

    signal: MarkSeconds
    blink: MarkSeconds
    head: MarkSeconds
    turn: MarkSeconds


@dataclass(frozen=True, slots=True)
class MarkupTable:
    """The table `markup.toml`."""

    duration: Durations
    signal: Mapping[str, float]
    gaze: Mapping[str, Direction]
    head: Mapping[str, Gesture]
    turn: Mapping[str, TurnAttitude]
    listen: TurnAttitude

    def __post_init__(self) -> None:
        resolve_targets(self.signal)


@cache
def markup_table() -> MarkupTable:
    """Return the package's table."""
    return load(MarkupTable, "markup.toml")
