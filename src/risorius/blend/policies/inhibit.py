"""Policy `inhibit`: the muscle of the lower priority gives way (paper A, section 6; DESIGN, section 3).

The policy computes with sets of times. An activity min(F, psi) exceeds its threshold while F does, except so
near to inhibited times that psi does not. So levels are resolved from the highest down without sampling any
frame.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array
from ..channels import Channel
from ..conflict import POLICIES, Join, PolicyInputs, Resolver, SuppressionEffect, Suppressor
from ..intervals import Spans, difference, dilated, intersection, neighbours, union


@POLICIES.register("inhibit")
class Inhibit:
    """Paper A's policy: 0 while a rival of higher priority is active, and slowed around such times."""

    join = Join.MAX

    def __init__(self, inputs: PolicyInputs) -> None:
        self._inputs = inputs
        self._active: dict[tuple[str, float, str], Spans] = {}
        self._at_level: dict[tuple[str, float, str], Spans] = {}
        self._inhibited: dict[tuple[str, str], Spans] = {}

    def at(self, times: Array) -> Resolver:
        """Return the function that resolves conflicts; it is the same at all times."""
        return self._resolve

    def _resolve(self, channel: Channel, parameter: str, times: Array, values: Array) -> Array:
        spans = self.inhibited(channel, parameter)
        if not len(spans):
            return values
        since, until = neighbours(spans, times)
        tuning = self._inputs.tuning
        released = _risen(since, tuning.min_onset[parameter])
        before = _risen(until, tuning.min_offset[parameter])
        return np.minimum(values, np.minimum(released, before))

    def inhibited(self, channel: Channel, parameter: str) -> Spans:
        """Return when a channel's parameter must be 0, shape (n, 2)."""
        key = (channel.key, parameter)
        if key not in self._inhibited:
            levels = channel.levels
            self._inhibited[key] = union(
                [
                    self._where(channel, self._inhibited_at(channel, level, parameter), level)
                    for level in levels.distinct
                ]
            )
        return self._inhibited[key]

    def _inhibited_at(self, channel: Channel, level: float, parameter: str) -> Spans:
        """Return when it would have to be 0 if the channel always had this level."""
        key = (channel.key, level, parameter)
        if key not in self._at_level:
            rivals = self._inputs.rivals(channel, parameter, level)
            self._at_level[key] = union([self.active(*rival) for rival in rivals])
        return self._at_level[key]

    def active(self, channel: Channel, level: float, parameter: str) -> Spans:
        """Return when a channel at a level has a resolved parameter above its threshold, shape (n, 2)."""
        key = (channel.key, level, parameter)
        if key not in self._active:
            inputs = self._inputs
            threshold = inputs.tuning.threshold[parameter]
            left = inputs.threshold_time(parameter, inputs.tuning.min_offset[parameter])
            right = inputs.threshold_time(parameter, inputs.tuning.min_onset[parameter])
            inhibited = dilated(self._known(channel, level, parameter), left, right)
            free = difference(channel.above(parameter, threshold), inhibited)
            if inputs.limits is not None:
                free = difference(free, inputs.limits.forbidden(channel, parameter, threshold))
            self._active[key] = self._where(channel, free, level)
        return self._active[key]

    def _known(self, channel: Channel, level: float, parameter: str) -> Spans:
        """Return the inhibited times that are known when this level is resolved.

        While the channel has a higher level, they are those of that level, else those of this level. The
        final set is never smaller, so that no activity that will be seen is overlooked.
        """
        inhibited = self._inhibited_at(channel, level, parameter)
        if channel.levels.constant is not None:
            return inhibited
        higher = [above for above in channel.levels.distinct if above > level]
        elsewhere = difference(inhibited, union([channel.levels.spans(above) for above in higher]))
        resolved = [self._where(channel, self._inhibited_at(channel, a, parameter), a) for a in higher]
        return union([elsewhere, *resolved])

    def _where(self, channel: Channel, spans: Spans, level: float) -> Spans:
        """Return those of the spans during which the channel has the level."""
        if channel.levels.constant is not None:
            return spans
        return intersection(spans, channel.levels.spans(level))

    def suppressor(self, channel: Channel, parameter: str, time: float) -> Suppressor | None:
        """Return the rival that inhibits an activity, or limits it because it acts soon or acted just now."""
        spans = self.inhibited(channel, parameter)
        if not len(spans):
            return None
        since, until = (float(x[0]) for x in neighbours(spans, np.array([time])))
        tuning = self._inputs.tuning
        if since <= 0.0:
            return self._culprit(SuppressionEffect.INHIBITED, channel, parameter, time)
        after, before = tuning.min_onset[parameter], tuning.min_offset[parameter]
        if since < after and since * before <= until * after:
            return self._culprit(SuppressionEffect.ONSET, channel, parameter, time - since)
        if until < before:
            return self._culprit(SuppressionEffect.OFFSET, channel, parameter, time + until)
        return None

    def _culprit(
        self, effect: SuppressionEffect, channel: Channel, parameter: str, time: float
    ) -> Suppressor | None:
        """Return the rival whose active time is nearest to `time`."""
        best: tuple[float, Suppressor] | None = None
        for level in channel.levels.distinct:
            for other, above, rival in self._inputs.rivals(channel, parameter, level):
                active = self.active(other, above, rival)
                if not len(active):
                    continue
                distance = np.maximum(np.maximum(active[:, 0] - time, time - active[:, 1]), 0.0)
                nearest = float(distance.min())
                if best is None or nearest < best[0]:
                    best = (nearest, Suppressor(effect, other.name, rival, time))
        return None if best is None else best[1]


def _risen(elapsed: Array, duration: float) -> Array:
    """Return phi_+ of the time elapsed: 0 before it, 1 after the duration, shape (n,)."""
    x = np.clip(elapsed / duration, 0.0, 1.0) if duration > 0.0 else np.asarray(elapsed > 0.0, np.float64)
    return np.exp2(x) - 1.0
