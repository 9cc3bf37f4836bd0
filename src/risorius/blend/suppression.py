"""How much of each parameter its rivals in other channels suppress."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from ..core.parameters import INDEX, NAMES
from .concatenate import SIGNED
from .plan import Moment, Plan


def suppression(plan: Plan, times: Array) -> Array:
    """Return the most that the policy takes from any channel, by parameter: sorted times (n,) -> (n, 46).

    The lips' limits and contact goals take more afterwards; that is not a conflict and does not count.
    """
    parts = [_at(Moment(plan, batch)) for batch in plan.batches(np.asarray(times, np.float64))]
    return np.concatenate(parts) if parts else np.zeros((0, len(NAMES)))


def _at(moment: Moment) -> Array:
    result = np.zeros((len(moment.times), len(NAMES)))
    for channel in moment.plan.channels:
        for name in channel.curves:
            if name in SIGNED:
                continue
            index, asked = channel.sample(name, moment.times)
            _, left = moment.resolved(channel, name)
            column = INDEX[name]
            result[index, column] = np.maximum(result[index, column], asked - left)
    return result
