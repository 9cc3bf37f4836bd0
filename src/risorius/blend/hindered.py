"""How much of what channels ask of each parameter their rivals keep down."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from ..core.parameters import INDEX, NAMES
from .concatenate import SIGNED
from .plan import Moment, Plan


def kept_down(plan: Plan, times: Array) -> Array:
    """Return the most that the policy takes from any channel, by parameter: sorted times (n,) -> (n, 46).

    What the lips' limits and contact goals take afterwards is no conflict and does not count.
    """
    parts = [_at(Moment(plan, piece)) for piece in plan.pieces(np.asarray(times, np.float64))]
    return np.concatenate(parts) if parts else np.zeros((0, len(NAMES)))


def _at(moment: Moment) -> Array:
    result = np.zeros((len(moment.times), len(NAMES)))
    for channel in moment.plan.channels:
        for name in channel.curves:
            if name in SIGNED:
                continue
            index, asked = channel.sample(name, moment.times)
            _, left = moment.settled(channel, name)
            column = INDEX[name]
            result[index, column] = np.maximum(result[index, column], asked - left)
    return result
