"""How other channels keep within the limits of speech.

"While lips speak they own the mouth's opening" (DESIGN, section 3). A channel that asks for more than a limit
keeps only a share of what it asks; that share falls before the limit binds and rises after it as fast as the
minimum durations let a muscle go from full to rest: half a contribution goes in half the time.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from .channels import Channel
from .intervals import EMPTY, Spans
from .knots import eased, lowest, paced, rounded
from .levels import Levels, outranking, outranks
from .mouth import JAW, KnotBlock, SpeechMouth

LIPS = "lips"
ROUNDED = 0.04
"""Seconds over which what a channel keeps turns from falling to rising: no corner is seen in a jaw."""


class SpeechLimits:
    """The limits of speech on every other channel. `lips`: the priority of speech.

    A channel that outranks speech is bound by closures only.
    """

    def __init__(self, mouth: SpeechMouth, lips: Levels) -> None:
        self.mouth, self._lips = mouth, lips

    def bind(self, channel: Channel, name: str) -> bool:
        """Return whether a channel's parameter is limited at some time."""
        return channel.name != LIPS and name in self.mouth.limited

    def jaw_share(self, channel: Channel, times: Array, own: Array) -> Array:
        """Return the share of a channel's jaw that is added to the lips' `own` at sorted times, shape (n,).

        It opens the jaw by its part of the way that speech leaves, so that it lowers a high jaw nearly as far
        as in silence and a low one less.
        """
        free = outranks(channel.levels, self._lips, times)
        return 1.0 - own * self.mouth.speaking_at(times) * (1.0 - free)

    def applied(self, channel: Channel, name: str, times: Array, values: Array, own: Array) -> Array:
        """Return what is left of a channel's values at sorted times, all shape (n,).

        `own`: what speech itself does; of the jaw, the limit is on the two together.
        """
        if not self.bind(channel, name):
            return values
        limit = self.limit(channel, name, times)
        room = np.maximum(limit - own, 0.0) if name == JAW else limit
        kept = self.mouth.interpolated(lambda block: self._kept(block, channel, name), times)
        return np.minimum(values * kept, room)

    def limit(self, channel: Channel, name: str, times: Array) -> Array:
        """Return the most that a channel may give to a parameter it is bound in, at sorted times, (n,)."""
        return self._freed(channel, times, self.mouth.high_at(name, times), self.mouth.closed_at(name, times))

    def _freed(self, channel: Channel, times: Array, high: Array, closed: Array) -> Array:
        free = outranks(channel.levels, self._lips, times)
        return np.minimum(high + free * (1.0 - high), closed) if free.any() else high

    def forbidden(self, channel: Channel, name: str, threshold: float) -> Spans:
        """Return when the limits do not let a channel's parameter pass the threshold, shape (n, 2)."""
        if not self.bind(channel, name):
            return EMPTY
        free = len(outranking(channel.levels, self._lips)) > 0
        return self.mouth.forbidden(name, threshold, closures_only=free)

    def _kept(self, block: KnotBlock, channel: Channel, name: str) -> Array:
        """The share that a channel keeps, at a block's knots."""
        key = (channel.name, name)
        if key not in block.kept:
            knots, tuning = block.knots, self.mouth.tuning
            asked = np.zeros(len(knots))
            index, values = channel.sample(name, knots)
            asked[index] = values
            limit = self._freed(channel, knots, block.limit(name), block.closures(name))
            if name == JAW:
                own = block.own(name)
                asked *= self.jaw_share(channel, knots, own)
                limit = np.maximum(limit - own, 0.0)
            share = np.divide(limit, asked, out=np.ones(len(knots)), where=asked > limit)
            if (share < 1.0).any():
                share = lowest(knots, share, ROUNDED)
                clock = paced(knots, asked)
                share = eased(clock, share, tuning.min_onset[name], tuning.min_offset[name])
                share = rounded(knots, share, ROUNDED)
            block.kept[key] = share
        return block.kept[key]
