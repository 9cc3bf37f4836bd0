"""The share of each parameter that its rivals in other channels suppress."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from ..core.parameters import INDEX, NAMES
from .concatenate import SIGNED
from .plan import Plan, PlanSample


def suppression(plan: Plan, times: Array) -> Array:
    """Return the most that the policy takes from any channel, by parameter: sorted times (n,) -> (n, 46).

    The lips' limits and contact goals take more afterwards; that is not a conflict and does not count.
    """
    batches = [_taken(PlanSample(plan, batch)) for batch in plan.batches(np.asarray(times, np.float64))]
    return np.concatenate(batches) if batches else np.zeros((0, len(NAMES)))


def _taken(sample: PlanSample) -> Array:
    taken = np.zeros((len(sample.times), len(NAMES)))
    for name in {name for channel in sample.plan.channels for name in channel.curves} - SIGNED:
        column = taken[:, INDEX[name]]
        for entry in sample.ledger(name).entries():
            column[entry.index] = np.maximum(column[entry.index], entry.requested - entry.resolved)
    return taken
