"""The table of channels: names, priorities, default timing, and sources.

Each channel is one file of the package `channels` that ends with a line `register(…)`. The table is made from
these lines, read as text: who reads or combines movements needs no builder.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import ParameterError, unknown
from .functions import ONSET_FUNCTIONS
from .registry import Registry, registrations

POSTURE_LAYER = "posture"
"""The layer of what a speaker always shows: it tells nothing of what is said or felt."""


@dataclass(frozen=True, slots=True)
class ChannelTiming:
    """The default timing of a channel's movements: seconds, and the name of an onset function."""

    onset: float
    offset: float
    function: str

    def __post_init__(self) -> None:
        ONSET_FUNCTIONS.get(self.function)
        if not (self.onset >= 0.0 and self.offset >= 0.0):
            raise ValueError(f"onset {self.onset} and offset {self.offset} must be 0 or more seconds")


@dataclass(frozen=True, slots=True)
class ChannelDeclaration:
    """The declaration of a channel, known before anything is built.

    `priority`: of its movements unless they have their own; the highest wins. `rules`, `marks`: whether rules
    and the marks of a script feed it. `exclusive`: while a mark moves parameters here, no rule moves them.
    `order`: channels are built in this order, those of the same in the order of their names. `timing`: None
    if neither rules nor marks feed it. `module`: the name of the module that registers it. `built`: whether
    that has a builder; curves drawn by hand come from scores alone.
    """

    name: str
    priority: float
    module: str
    built: bool
    rules: bool = False
    marks: bool = False
    exclusive: bool = False
    order: int = 0
    timing: ChannelTiming | None = None

    def __post_init__(self) -> None:
        if (self.rules or self.marks) and self.timing is None:
            raise ValueError(f"channel '{self.name}' is fed by rules or marks; expected a timing")


def _declared() -> Iterator[ChannelDeclaration]:
    """Yield the channels that the files of the package `channels` register."""
    root = Path(__file__).parent.parent
    for line in registrations(root / "channels", f"{root.name}.channels", 2):
        name, priority, *build = line.arguments
        options: dict[str, Any] = dict(line.keywords)
        timing = ChannelTiming(*options.pop("timing")) if "timing" in options else None
        yield ChannelDeclaration(name, priority, line.module, bool(build), timing=timing, **options)


CHANNELS: Registry[ChannelDeclaration] = Registry("channel")
for _channel in sorted(_declared(), key=lambda channel: (-channel.priority, channel.name)):
    CHANNELS.register(_channel.name)(_channel)


def channel_timing(name: str) -> ChannelTiming:
    """Return the default timing of a channel; raise ParameterError if it has none."""
    timing = CHANNELS.get(name).timing if name in CHANNELS else None
    if timing is None:
        timed = [known for known in CHANNELS if CHANNELS.get(known).timing is not None]
        raise ParameterError(unknown("channel with timing", name, timed))
    return timing
