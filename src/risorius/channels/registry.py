"""What a channel is given, and the table of channels."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from ..core.movement import LipSegment, Movement
from ..core.utterance import Utterance
from ..registry import Registry
from ..rules.emotions import Display


@dataclass(frozen=True, slots=True)
class Brief:
    """All that a channel may build from.

    `utterance` is None where nothing is said. `marks`: the script's movements, of all channels. `emotions`:
    the displays asked for beside the script. `opens`: whether the mouth may open before speech and close
    after it (plain text). `lively`: whether random blinks, small head and eye movements are wanted.
    """

    duration: float
    utterance: Utterance | None = None
    marks: tuple[Movement, ...] = ()
    emotions: tuple[Display, ...] = ()
    opens: bool = True
    articulation: float = 1.0
    manner: str = "plain"
    lively: bool = True


Built = Iterable[Movement | LipSegment]
ChannelBuilder = Callable[[Brief, np.random.Generator], Built]

CHANNEL_BUILDERS: Registry[ChannelBuilder] = Registry("channel")


def generator(seed: int, channel: str) -> np.random.Generator:
    """Return the channel's own random generator: it depends on the seed and the name alone."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, zlib.crc32(channel.encode())])))
