"""Policy `graded`: the lower priority gives way by degrees (DESIGN, section 3).

The share that a rival takes grows smoothly from 0 at its threshold to 1 at `WIDTH` above it. The rest changes
no faster than the minimum durations allow; for that, a rival takes its share some time before and after it
acts, too. Shares are computed on knots: the times at which some movement starts or ends, and times between
them at most `STEP` apart, so that they do not depend on the frame rate.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ...core.arrays import Array
from ...core.parameters import RIVALS
from ..channels import Channel
from ..conflict import POLICIES, Join, PolicyInputs, Resolver, Suppressor
from ..knots import LEAST_REQUESTED, STEEPEST, Knots, rate_limited, slowed_clock, smoothstep
from .strength import Strengths

WIDTH = 0.4
"""The distance from a rival's threshold to the activity at which it takes everything."""
STEP = 0.005
"""Largest distance of knots, seconds."""
CELL = 10.0
"""Shares are computed for at least this number of seconds. Results do not depend on it."""


@POLICIES.register("graded")
class Graded:
    """aF = F·(1 - smoothstep of the strongest rival over [threshold, threshold + 0.4]), slowed."""

    join = Join.MAX

    def __init__(self, inputs: PolicyInputs) -> None:
        self._inputs = inputs
        curves = [
            k for c in inputs.channels for name, drawn in c.curves.items() if RIVALS[name] for k in drawn
        ]
        changes = [c.levels.times[1:] for c in inputs.channels]
        times = np.unique(np.concatenate([*(curve.breakpoints() for curve in curves), *changes, []]))
        self._knots = Knots(times[np.isfinite(times)] if len(times) else np.zeros(1), STEP)
        # Each level may carry a change one minimum duration further.
        levels = {level for c in inputs.channels for level in c.levels.distinct}
        self._margin = inputs.tuning.longest * (len(levels) + 1)
        self._cells = lru_cache(maxsize=3)(self._make_cells)

    def _make_cells(self, first: int, last: int) -> Strengths:
        knots = self._knots.between(first * CELL - self._margin, last * CELL + self._margin)
        threshold, tuning = self._inputs.tuning.threshold, self._inputs.tuning

        def strength(rival: str, activity: Array) -> Array:
            return np.clip((activity - threshold[rival]) / WIDTH, 0.0, 1.0)

        def gain(channel: Channel, parameter: str, strongest: Array) -> Array:
            onset, offset = tuning.min_onset[parameter], tuning.min_offset[parameter]
            clock = slowed_clock(knots, channel.lines(parameter, knots))
            return rate_limited(clock, smoothstep(1.0 - strongest), onset, offset)

        return Strengths(self._inputs, knots, strength, gain)

    def at(self, times: Array) -> Resolver:
        """Return the function that resolves conflicts at some of the sorted times."""
        strengths = self._around(times[0], times[-1])

        def resolve(channel: Channel, parameter: str, times: Array, values: Array) -> Array:
            gain = strengths.gain(channel, parameter)
            return values if gain is strengths.whole else values * np.interp(times, strengths.times, gain)

        return resolve

    def _around(self, first: float, last: float) -> Strengths:
        """Return the strengths in the cells around some times: few cells take little time."""
        return self._cells(math.floor(first / CELL), math.floor(last / CELL) + 1)

    def suppressor(self, channel: Channel, parameter: str, time: float) -> Suppressor | None:
        """Return the rival that takes most of an activity, or None."""
        strengths = self._around(time, time)
        tuning = self._inputs.tuning
        # A share goes from all to nothing within this time, so no rival has an effect for longer.
        pace = STEEPEST * max(float(channel.lines(parameter, np.array([time]))[0]), LEAST_REQUESTED)
        onset, offset = tuning.min_onset[parameter], tuning.min_offset[parameter]
        return strengths.strongest(channel, parameter, time, pace * onset, pace * offset)
