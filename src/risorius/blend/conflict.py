"""Conflicts between channels: what every policy is given and what it must answer.

A policy is a file in `policies/` that registers itself here. It decides what is left of each channel's
activity; the lips' limits and contact goals hold under every policy and come after it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

import numpy as np

from ..core.parameters import RIVALS
from ..registry import Registry
from .channels import Channel
from .intervals import EMPTY, Array, Spans
from .levels import Levels, outranking, outranks
from .mouth import Mouth
from .tuning import Tuning

Settle = Callable[[Channel, str, Array, Array], Array]
"""(channel, parameter, times (n,), activity there (n,)) -> what is left of it (n,)."""


class Join(StrEnum):
    """How the channels' settled activities become one value."""

    MAX = "max"
    SUM = "sum"


class Effect(StrEnum):
    """What a rival does to an activity; the rival completes the sentence."""

    INHIBITED = "inhibited by"
    OFFSET = "limited by its minimum offset before"
    ONSET = "limited by its minimum onset after"
    WEAKENED = "weakened by"


@dataclass(frozen=True, slots=True)
class Hindrance:
    """Why an activity is less than its movement asks: a rival parameter, its channel, and when it is active."""

    effect: Effect
    channel: str
    parameter: str
    time: float


class Policy(Protocol):
    """Decides between rivals in different channels."""

    join: Join

    def at(self, times: Array) -> Settle:
        """Return the function that settles activities at some of the sorted times, shape (n,)."""

    def hindrance(self, channel: Channel, parameter: str, time: float) -> Hindrance | None:
        """Return what keeps an activity down at a time, or None if nothing does."""


@dataclass(frozen=True, slots=True)
class Field:
    """What a policy is given: the channels, the minimum durations and thresholds, and the mouth's limits.

    `lips`: the priority of speech, which owns the mouth's opening.
    """

    channels: Sequence[Channel]
    tuning: Tuning
    mouth: Mouth | None
    lips: Levels

    def rivals(self, channel: Channel, parameter: str, level: float) -> list[tuple[Channel, float, str]]:
        """Return every (other channel, its level, rival parameter) that outranks `level`."""
        return [
            (other, above, rival)
            for rival in RIVALS[parameter]
            for other in self.channels
            if other is not channel and rival in other.curves
            for above in other.levels.distinct
            if above > level
        ]

    def bound(self, channel: Channel, parameter: str) -> Mouth | None:
        """Return the mouth if it limits a channel's parameter at some time, else None."""
        if self.mouth is None or channel.name == LIPS or parameter not in self.mouth.limited:
            return None
        return self.mouth

    def limit(self, channel: Channel, parameter: str, times: Array) -> Array | None:
        """Return the most that a channel may give to a parameter at sorted times, (n,); None: no limit.

        A channel that outranks speech is bound by closures only (DESIGN, section 3, "Lips").
        """
        mouth = self.bound(channel, parameter)
        if mouth is None:
            return None
        high = mouth.high_at(parameter, times)
        free = outranks(channel.levels, self.lips, times)
        if not free.any():
            return high
        return np.minimum(high + free * (1.0 - high), mouth.closed_at(parameter, times))

    def forbidden(self, channel: Channel, parameter: str, threshold: float) -> Spans:
        """Return when the lips' limits do not let a channel's parameter pass the threshold, shape (n, 2)."""
        mouth = self.bound(channel, parameter)
        if mouth is None:
            return EMPTY
        free = len(outranking(channel.levels, self.lips)) > 0
        return mouth.forbidden(parameter, threshold, closures_only=free)

    def threshold_time(self, parameter: str, duration: float) -> float:
        """Return how long an activity needs to pass its threshold, given the time that it needs to pass 1."""
        return duration * float(np.log2(1.0 + self.tuning.threshold[parameter]))


LIPS = "lips"

POLICIES: Registry[Callable[[Field], Policy]] = Registry("conflict policy")
