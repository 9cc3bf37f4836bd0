"""The table of streaming protocols."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from ..errors import InputError, unknown
from ..face.arkit_fit import ArkitTrack
from ..registry import Registry

NAMES = ("vrm0", "vrm1", "arkit", "ARKit")


@dataclass(frozen=True, slots=True)
class Options:
    """`subject`: who is shown, by which a receiver tells several apart. `names` of expressions over VMC: the
    presets of VRM 0 or VRM 1, or the 52 shapes (Perfect Sync) with a small or a capital first letter.
    """

    subject: str = "risorius"
    names: str = "vrm0"

    def __post_init__(self) -> None:
        if self.names not in NAMES:
            raise InputError(unknown("set of names", self.names, NAMES))
        if not 0 < len(self.subject.encode()) <= 100:
            raise InputError(f"the subject '{self.subject}' is empty or longer than 100 bytes")


Packets = Callable[[int], Sequence[bytes]]
"""Returns the datagrams of a frame, by its index."""


@dataclass(frozen=True, slots=True)
class Protocol:
    """A protocol: its usual port, and `make(track, fps, options)`, which returns its packets."""

    port: int
    description: str
    make: Callable[[ArkitTrack, Fraction, Options], Packets]


PROTOCOLS: Registry[Protocol] = Registry("protocol")


def register(
    name: str, port: int, description: str, make: Callable[[ArkitTrack, Fraction, Options], Packets]
) -> None:
    """Add a protocol."""
    PROTOCOLS.register(name)(Protocol(port, description, make))
