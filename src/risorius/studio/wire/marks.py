"""A user's additions to a take beside its movements: markers, and lanes muted, alone or locked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from ...core.channels import CHANNELS
from ...core.units import Seconds
from ...errors import InputError
from ...reading.hints import Then

MOST_MARKERS = 500
LONGEST_TEXT = 120


def _short(text: str) -> str:
    return text[:LONGEST_TEXT]


def _channels(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names in the order of the channels, each once; raise InputError for an unknown one."""
    for name in names:
        CHANNELS.get(name)
    return tuple(name for name in CHANNELS if name in names)


def _few(markers: tuple[Marker, ...]) -> tuple[Marker, ...]:
    if len(markers) > MOST_MARKERS:
        raise InputError(f"{len(markers)} markers; expected up to {MOST_MARKERS}")
    return tuple(sorted(markers, key=lambda marker: marker.time))


ChannelNames = Annotated[tuple[str, ...], Then(_channels)]


@dataclass(frozen=True, slots=True)
class Marker:
    """A time with a note."""

    time: Seconds
    text: Annotated[str, Then(_short)] = ""


Markers = Annotated[tuple[Marker, ...], Then(_few)]


@dataclass(frozen=True, slots=True)
class LaneStates:
    """Channels that are muted, those that act alone (`solo`), and those that are locked against changes.

    Muted lanes move nothing, also in exports. If any is solo, all others are as if muted.
    """

    muted: ChannelNames = ()
    solo: ChannelNames = ()
    locked: ChannelNames = ()

    @property
    def silent(self) -> frozenset[str]:
        """The channels that move nothing."""
        return frozenset(CHANNELS) - set(self.solo) if self.solo else frozenset(self.muted)
