"""How fast movements come and go where nothing else says: onset, offset and function by channel."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

from ..core.functions import ONSET_FUNCTIONS
from ..core.movement import CHANNEL_PRIORITY
from ..core.units import RiseSeconds
from ..errors import ParameterError, unknown
from .load import load


@dataclass(frozen=True, slots=True)
class Timing:
    """Seconds of onset and offset, and the name of the onset function."""

    onset: RiseSeconds
    offset: RiseSeconds
    function: str

    def __post_init__(self) -> None:
        ONSET_FUNCTIONS.get(self.function)


@dataclass(frozen=True, slots=True)
class Saccade:
    """The main sequence of the eyes: seconds = latency + per_degree · degrees."""

    latency: RiseSeconds
    per_degree: RiseSeconds


@dataclass(frozen=True, slots=True)
class TimingTable:
    """The table `timing.toml`."""

    saccade: Saccade
    channels: Mapping[str, Timing]

    def __post_init__(self) -> None:
        for name in self.channels:
            if name not in CHANNEL_PRIORITY:
                raise ParameterError(unknown("channel", name, CHANNEL_PRIORITY))


@cache
def timing_table() -> TimingTable:
    """Return the package's table."""
    return load(TimingTable, "timing.toml")


def channel_timing(channel: str) -> Timing:
    """Return the default timing of a channel; raise ParameterError if it has none."""
    channels = timing_table().channels
    if channel not in channels:
        raise ParameterError(unknown("channel with timing", channel, channels))
    return channels[channel]


def saccade_duration(degrees: float) -> float:
    """Return how many seconds the eyes take for a turn of `degrees` (facts: science/03, section 3.3)."""
    saccade = timing_table().saccade
    return saccade.latency + saccade.per_degree * abs(degrees)
