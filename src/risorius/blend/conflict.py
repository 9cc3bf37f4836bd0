"""Conflicts between channels: the interface of a policy, and its inputs.

A policy is a file in `policies/` that registers itself here. It decides how much of each channel's activity
remains. The lips' limits and contact goals come after it and hold under every policy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Protocol

import numpy as np

from ..core.arrays import Array
from ..core.parameters import RIVALS
from ..core.registry import Registry
from .channels import Channel
from .layer_priority import ONE_PRIORITY
from .mouth.limits import SpeechLimits
from .tuning import Tuning

Resolver = Callable[[Channel, str, Array, Array], Array]
"""(channel, parameter, times (n,), requested values (n,)) -> the values after the policy (n,)."""


class Join(StrEnum):
    """The way to join the values of all channels: the largest, or all added and clipped. SUM also adds
    movements that are `on_top`, which otherwise add to the rest that the others leave.
    """

    MAX = "max"
    ADD = "add"
    SUM = "sum"


class SuppressionEffect(StrEnum):
    """The effect of a rival on an activity; the rival's name completes the sentence."""

    INHIBITED = "inhibited by"
    OFFSET = "limited by its minimum offset before"
    ONSET = "limited by its minimum onset after"
    WEAKENED = "weakened by"


@dataclass(frozen=True, slots=True)
class Suppressor:
    """The rival that makes an activity less than its movement requests, its channel, and when it acts."""

    effect: SuppressionEffect
    channel: str
    parameter: str
    time: float


class Policy(Protocol):
    """Decides between rivals in different channels."""

    join: Join

    def at(self, times: Array) -> Resolver:
        """Return the function that resolves conflicts at some of the sorted times, shape (n,)."""

    def suppressor(self, channel: Channel, parameter: str, time: float) -> Suppressor | None:
        """Return the rival that suppresses an activity at a time, or None."""


@dataclass(frozen=True, slots=True)
class PolicyInputs:
    """The inputs of a policy: the channels, minimum durations and thresholds, and the limits of speech."""

    channels: Sequence[Channel]
    tuning: Tuning
    limits: SpeechLimits | None

    def rivals(self, channel: Channel, parameter: str, level: float) -> list[tuple[Channel, float, str]]:
        """Return every (other channel, its level, rival parameter) that outranks `level`."""
        return [
            (other, above, rival)
            for rival in RIVALS[parameter]
            for other in self.channels
            if other is not channel and rival in other.curves and rival not in other.harmless
            for above in other.levels.distinct
            if above > (level if other.name == channel.name else level + ONE_PRIORITY)
        ]

    def threshold_time(self, parameter: str, duration: float) -> float:
        """Return the time in which an activity rises to its threshold if it needs `duration` to rise to 1."""
        return duration * float(np.log2(1.0 + self.tuning.threshold[parameter]))


POLICIES: Registry[Callable[[PolicyInputs], Policy]] = Registry("conflict policy")
