"""Policy `attenuate`: channels add, and the lower priority becomes smaller, but never disappears.

Paper B, sections 4.4 and 6.4.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array
from ..channels import Channel
from ..conflict import POLICIES, Join, PolicyInputs, Resolver, Suppressor
from .strength import Strengths

SHARE = 0.8
"""The share of an activity that a rival at full strength takes."""


@POLICIES.register("attenuate")
class Attenuate:
    """aF = F·(1 - 0.8·strongest rival of higher priority)."""

    join = Join.ADD

    def __init__(self, inputs: PolicyInputs) -> None:
        self._inputs = inputs

    def _strengths(self, times: Array) -> Strengths:
        return Strengths(
            self._inputs,
            times,
            lambda rival, activity: activity,
            lambda _channel, _parameter, x: 1.0 - SHARE * x,
        )

    def at(self, times: Array) -> Resolver:
        """Return the function that resolves conflicts at some of the sorted times."""
        strengths = self._strengths(times)

        def resolve(channel: Channel, parameter: str, own: Array, values: Array) -> Array:
            gain = strengths.gain(channel, parameter)
            return values * (gain if len(own) == len(times) else gain[np.searchsorted(times, own)])

        return resolve

    def suppressor(self, channel: Channel, parameter: str, time: float) -> Suppressor | None:
        """Return the rival that takes most of an activity, or None."""
        return self._strengths(np.array([time])).strongest(channel, parameter, time)
