"""Channels that hold, for now, only what the script marks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..core.movement import Movement
from .registry import CHANNEL_BUILDERS, Brief, ChannelBuilder


def _marked(channel: str) -> ChannelBuilder:
    def build(brief: Brief, rng: np.random.Generator) -> Iterator[Movement]:
        return (m for m in brief.marks if m.channel == channel)

    return build


for _channel in ("signals", "punctuators", "regulators"):
    CHANNEL_BUILDERS.register(_channel)(_marked(_channel))
