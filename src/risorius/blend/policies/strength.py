"""The common part of the policies that weaken an activity by the strength of its rivals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...core.arrays import Array
from ...core.time import TICK
from ..channels import Channel
from ..conflict import PolicyInputs, SuppressionEffect, Suppressor

Strength = Callable[[str, Array], Array]
"""(rival parameter, its resolved activity (n,)) -> how strong it is, 0..1 (n,)."""
GainOf = Callable[[Channel, str, Array], Array]
"""(channel, parameter, strength of its strongest rival (n,)) -> the share that remains, 0..1 (n,)."""


class Strengths:
    """Gains of all activities at some sorted times, resolved from the highest level down.

    A change of priority takes effect over a short ramp (`levels.PRIORITY_RAMP`), so that it makes no jump.
    `whole` is the gain, shape (n,), of an activity that no rival weakens.
    """

    def __init__(self, inputs: PolicyInputs, times: Array, strength: Strength, gain_of: GainOf) -> None:
        self._inputs, self.times, self.whole = inputs, times, np.ones(len(times))
        self._strength, self._gain_of = strength, gain_of
        self._gains: dict[tuple[str, float, str], Array] = {}
        self._strengths: dict[tuple[str, float, str], Array] = {}

    def gain(self, channel: Channel, parameter: str) -> Array:
        """Return the share that remains of a channel's activity in a parameter, 0..1, shape (n,)."""
        levels = channel.levels
        if levels.constant is not None:
            return self._gain_at(channel, levels.constant, parameter)
        total = np.zeros(len(self.times))
        for level in levels.distinct:
            total += levels.weight(level, self.times) * self._gain_at(channel, level, parameter)
        return total

    def _gain_at(self, channel: Channel, level: float, parameter: str) -> Array:
        key = (channel.key, level, parameter)
        if key not in self._gains:
            strongest = np.zeros(len(self.times))
            for other, above, rival in self._inputs.rivals(channel, parameter, level):
                np.maximum(strongest, self._strength_of(other, above, rival), out=strongest)
            weakened = strongest.any()
            self._gains[key] = self._gain_of(channel, parameter, strongest) if weakened else self.whole
        return self._gains[key]

    def _strength_of(self, channel: Channel, level: float, parameter: str) -> Array:
        """Return how strong a channel at a level is against the rivals of its parameter, shape (n,)."""
        key = (channel.key, level, parameter)
        if key not in self._strengths:
            activity = channel.lines(parameter, self.times)
            gain = self._gain_at(channel, level, parameter)
            if gain is not self.whole:
                activity *= gain
            limits = self._inputs.limits
            if limits is not None and limits.bind(channel, parameter):
                np.minimum(activity, limits.limit(channel, parameter, self.times), out=activity)
            strength = self._strength(parameter, activity)
            self._strengths[key] = strength * channel.levels.weight(level, self.times)
        return self._strengths[key]

    def strongest(
        self, channel: Channel, parameter: str, time: float, onset: float = 0.0, offset: float = 0.0
    ) -> Suppressor | None:
        """Return the rival that takes most at a time, or None if none takes anything.

        A rival takes less the longer ago it acted or the later it will act: nothing `offset` seconds before
        and `onset` seconds after.
        """
        ahead = self.times - time
        pace = np.maximum(np.where(ahead > 0.0, offset, onset), TICK)
        faded = np.abs(ahead) / pace
        # A value between two of the times is interpolated from both.
        nearest = int(np.searchsorted(self.times, time))
        faded[max(nearest - 1, 0) : nearest + 1] = 0.0
        best, suppressor = 0.0, None
        for level in channel.levels.distinct:
            share = float(channel.levels.weight(level, np.array([time]))[0])
            for other, above, rival in self._inputs.rivals(channel, parameter, level) if share > 0.0 else ():
                felt = share * (self._strength_of(other, above, rival) - faded)
                k = int(np.argmax(felt))
                if felt[k] > best:
                    when = float(self.times[k])
                    best, suppressor = (
                        float(felt[k]),
                        Suppressor(SuppressionEffect.WEAKENED, other.name, rival, when),
                    )
        return suppressor
