"""Policy `graded`: the lower priority gives way by degrees (DESIGN, section 3).

The share that a rival takes grows smoothly from nothing at its threshold to all at `WIDTH` above it, and
what is left changes no faster than the minimum durations allow: a rival counts as strong as it needs to be
for that, before it acts and after. It is worked on knots: the times at which some movement starts or ends,
and times between them at most `STEP` apart, so that it does not depend on the frame rate.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from ...core.parameters import RIVALS
from ..channels import Channel
from ..conflict import POLICIES, Field, Hindrance, Join, Settle
from ..intervals import Array
from ..knots import STEEPEST, Knots, block_knots, block_number, eased
from .strength import Strengths

WIDTH = 0.4
"""From a rival's threshold to the activity at which it takes all."""
STEP = 0.005
"""Seconds between knots at most."""


@POLICIES.register("graded")
class Graded:
    """aF = F·(1 - smoothstep of the strongest rival over [threshold, threshold + 0.4]), slowed."""

    join = Join.MAX

    def __init__(self, field: Field) -> None:
        self._field = field
        curves = [
            k for c in field.channels for name, drawn in c.curves.items() if RIVALS[name] for k in drawn
        ]
        changes = [c.levels.times[1:] for c in field.channels]
        times = np.unique(np.concatenate([*(curve.breakpoints() for curve in curves), *changes, []]))
        self._knots = Knots(times[np.isfinite(times)] if len(times) else np.zeros(1), STEP)
        # Each level settled may carry a change one minimum duration further.
        levels = {level for c in field.channels for level in c.levels.distinct}
        self._margin = field.tuning.longest * (len(levels) + 1)
        self._block = lru_cache(maxsize=2)(self._make_block)

    def _make_block(self, number: int) -> Strengths:
        knots = block_knots(self._knots, number, self._margin)
        threshold, tuning = self._field.tuning.threshold, self._field.tuning

        def strength(rival: str, activity: Array) -> Array:
            return np.clip((activity - threshold[rival]) / WIDTH, 0.0, 1.0)

        def kept(parameter: str, strongest: Array) -> Array:
            onset, offset = tuning.min_onset[parameter], tuning.min_offset[parameter]
            return eased(knots, 1.0 - strongest, onset, offset)

        return Strengths(self._field, knots, strength, kept)

    def at(self, times: Array) -> Settle:
        """Return the function that settles activities at some of the sorted times."""
        return self._settle

    def _settle(self, channel: Channel, parameter: str, times: Array, values: Array) -> Array:
        if not len(times):
            return values
        block = self._block(block_number(times[0]))
        return values * np.interp(times, block.times, block.gain(channel, parameter))

    def hindrance(self, channel: Channel, parameter: str, time: float) -> Hindrance | None:
        """Return the rival that takes most of an activity, or None."""
        block = self._block(block_number(time))
        tuning = self._field.tuning
        onset, offset = tuning.min_onset[parameter], tuning.min_offset[parameter]
        return block.strongest(channel, parameter, time, STEEPEST * onset, STEEPEST * offset)
