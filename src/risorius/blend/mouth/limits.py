"""The limits of speech on other channels.

"While lips speak they own the mouth's opening" (DESIGN, section 3). If a channel requests more than a limit,
it gets only a share of its request. The share falls before the limit begins and rises after it has ended, as
fast as the minimum durations let a muscle go from full to rest; half a request goes in half the time.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array
from ..channels import Channel
from ..intervals import EMPTY, Spans
from ..knots import rate_limited, slowed_clock
from ..priority_curve import PriorityCurve, outranking, outranks
from .speech_mouth import JAW, ROUNDED, KnotBlock, RequestShare, SpeechMouth

LIPS = "lips"


class SpeechLimits:
    """The limits of speech on every other channel. `lips`: the priority of speech.

    Only closures limit a channel that outranks speech.
    """

    def __init__(self, mouth: SpeechMouth, lips: PriorityCurve) -> None:
        self.mouth, self._lips = mouth, lips

    def bind(self, channel: Channel, name: str) -> bool:
        """Return whether a channel's parameter is limited at some time."""
        return channel.name != LIPS and name in self.mouth.limited

    def jaw_share(self, channel: Channel, times: Array, speech: Array) -> Array:
        """Return the share of a channel's jaw that is added to the jaw of `speech` at sorted times, shape
        (n,).

        The channel opens the jaw by its part of the way that speech leaves: it lowers a high jaw nearly as
        far as in silence, and a low jaw less.
        """
        free = outranks(channel.levels, self._lips, times)
        return 1.0 - speech * self.mouth.speaking_at(times) * (1.0 - free)

    def applied(self, channel: Channel, name: str, times: Array, values: Array, speech: Array) -> Array:
        """Return a channel's values within the limits at sorted times, all shape (n,).

        `speech`: the values of speech; the limit on the jaw is on the sum of both.
        """
        if not self.bind(channel, name):
            return values
        share = self.mouth.interpolated(lambda block: self._share_of(block, channel, name), times)
        if name == JAW:
            # The share keeps the sum below the limit and changes at the muscle's pace. A limit that did so
            # would cross the jaw of speech in a corner.
            return values * share
        return np.minimum(values * share, self.limit(channel, name, times))

    def limit(self, channel: Channel, name: str, times: Array) -> Array:
        """Return the most that a channel may add to a limited parameter at sorted times, shape (n,)."""
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

    def _share_of(self, block: KnotBlock, channel: Channel, name: str) -> Array:
        """Return the share of its request that a channel gets, at a block's knots."""
        key, curves, levels = (channel.key, name), channel.curves[name], (channel.levels, self._lips)
        known = block.shares.get(key)
        if known is None or not known.serves(curves, levels):
            values = self._computed_share(block, channel, name)
            known = block.shares[key] = RequestShare(tuple(curves), levels, values)
        return known.values

    def _computed_share(self, block: KnotBlock, channel: Channel, name: str) -> Array:
        knots, tuning = block.knots, self.mouth.tuning
        requested = np.zeros(len(knots))
        index, values = channel.sample(name, knots)
        requested[index] = values
        limit = self._freed(channel, knots, block.limit(name), block.closures(name))
        if name == JAW:
            speech = block.own(name)
            requested *= self.jaw_share(channel, knots, speech)
            limit = np.maximum(limit - speech, 0.0)
        share = np.divide(limit, requested, out=np.ones(len(knots)), where=requested > limit)
        if (share < 1.0).any():
            around, clock = block.around(ROUNDED), slowed_clock(knots, requested)
            share = around.lowest(share)
            share = rate_limited(clock, share, tuning.min_onset[name], tuning.min_offset[name])
            share = around.average(share)
        return share
