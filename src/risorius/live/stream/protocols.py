"""The table of streaming protocols."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from fractions import Fraction

from ...core.arrays import Array
from ...core.choices import EXPRESSION_NAMES
from ...core.registry import Registry
from ...errors import InputError, UnusedSettingError, unknown

NAMES = tuple(EXPRESSION_NAMES)


@dataclass(frozen=True, slots=True)
class Asked:
    """The request in a receiver's handshake: a protocol, at its usual port, and the protocol's dialect."""

    protocol: str
    dialect: str


Greetings = Mapping[bytes, Asked]
"""The handshakes of receivers, and what each requests."""


@dataclass(frozen=True, slots=True)
class Options:
    """`subject`: the subject name; receivers use it to distinguish faces. `names` of expressions over VMC:
    the presets of VRM 0 or VRM 1, or the 52 shapes (Perfect Sync) with a small or a capital first letter.
    `dialect`: that of the receiver's handshake, if the protocol has dialects.
    """

    subject: str = "risorius"
    names: str = "vrm0"
    dialect: str = ""

    def __post_init__(self) -> None:
        if self.names not in NAMES:
            raise InputError(unknown("set of names", self.names, NAMES))
        if not 0 < len(self.subject.encode()) <= 100:
            raise InputError(f"the subject '{self.subject}' is empty or longer than 100 bytes")


@dataclass(frozen=True, slots=True)
class ArkitMoment:
    """A frame in ARKit's terms: its `index`, weights (52,), and the rotations of head (3,) and eyes (2, 3) in
    degrees, as in `ArkitTrack`.

    For VRM's presets also by how much vowels are less because the lips are `shut`, and the weights (4,) of
    those that emotions alone move.
    """

    index: int
    weights: Array
    head: Array
    eyes: Array
    shut: float = 0.0
    emotion: Array | None = None


Packets = Callable[[ArkitMoment], Sequence[bytes]]
"""Returns the datagrams of a frame."""


@dataclass(frozen=True, slots=True)
class Protocol:
    """A protocol: its receivers' usual port, and `make(fps, options)`, which returns its packets.

    `greetings`: what a receiver says first to that port of ours, if the protocol has that. `tcp`: the
    packets are pieces of one stream, not datagrams. `reads`: the options that it reads.
    """

    port: int
    description: str
    make: Callable[[Fraction, Options], Packets]
    greetings: Greetings = field(default_factory=dict)
    tcp: bool = False
    reads: tuple[str, ...] = ()


PROTOCOLS: Registry[Protocol] = Registry("protocol")


def register(
    name: str,
    port: int,
    description: str,
    make: Callable[[Fraction, Options], Packets],
    greetings: Greetings | None = None,
    *,
    tcp: bool = False,
    reads: tuple[str, ...] = (),
) -> None:
    """Add a protocol."""
    PROTOCOLS.register(name)(Protocol(port, description, make, greetings or {}, tcp, reads))


def check_options(name: str, options: Options) -> None:
    """Raise UnusedSettingError for options that are given and that the protocol `name` does not read."""
    usual, reads = Options(), PROTOCOLS.get(name).reads
    changed = [f.name for f in fields(options) if getattr(options, f.name) != getattr(usual, f.name)]
    unread = [option for option in changed if option not in reads]
    if unread:
        readers = [other for other in PROTOCOLS if unread[0] in PROTOCOLS.get(other).reads]
        raise UnusedSettingError(
            unread, f"{name} does not use it; expected the protocol {' or '.join(readers)}"
        )
