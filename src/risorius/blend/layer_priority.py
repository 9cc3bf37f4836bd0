"""Rivals within a channel: of layers that conflict, the one whose movement started later wins.

Paper A, section 2: a channel holds only movements that do not conflict. Layers that move rivals at the same
time become strata: channels of the same name whose priorities differ by less than those of two channels do,
so that the policy decides between them as it does between channels.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Mapping, Sequence

import numpy as np

from ..core.parameters import RIVALS
from .concatenate import LayerCurves
from .priority_curve import PriorityCurve

STEP = 1e-6
"""The difference of priority between a stratum and the one above it."""
ONE_PRIORITY = 1e-3
"""Strata of a channel differ by less: to other channels they are of one priority."""

LayerKey = tuple[bool, str]
"""Whether the layer adds on top of others, and its name."""


def layer_priorities(
    layers: Mapping[LayerKey, LayerCurves], priority: PriorityCurve, order: Mapping[int, int]
) -> dict[LayerKey, PriorityCurve]:
    """Return the priority over time of each layer that conflicts with another of the channel.

    `order`: the place in the score of each movement, by its `id()`. The channel's own `priority` is that of
    the layer whose movement started last; of two that started together, the one with the larger target, then
    the later in the score, comes first.
    """
    rivals = [key for key in layers if any(_conflict(layers[key], layers[k]) for k in layers if k != key)]
    if not rivals:
        return {}
    starts = {key: _ranked(layers[key], order) for key in rivals}
    times = sorted({row[0] for rows in starts.values() for row in rows})
    edges = np.unique(np.concatenate((priority.times, times)))
    below = {key: np.zeros(len(edges)) for key in rivals}
    for index, time in enumerate(edges):
        latest = sorted(rivals, key=lambda key: _latest(starts[key], float(time)), reverse=True)
        for rank, key in enumerate(latest):
            below[key][index] = rank * STEP
    return {key: PriorityCurve(edges, priority.at(edges) - below[key]) for key in rivals}


Start = tuple[float, float, int]
"""The start of a step, its largest target, and its movement's place in the score."""


def _ranked(layer: LayerCurves, order: Mapping[int, int]) -> list[Start]:
    return [
        (s.start, max((abs(v) for v in s.targets.values()), default=0.0), order[id(s.movement)])
        for s in layer.steps
    ]


def _latest(starts: Sequence[Start], time: float) -> Start:
    """Return the last of a layer's steps that has started."""
    index = bisect_right(starts, time, key=lambda start: start[0])
    return starts[index - 1] if index else (-np.inf, starts[0][0], starts[0][2])


def _conflict(one: LayerCurves, other: LayerCurves) -> bool:
    """Tell whether two layers move rivals at the same time."""
    moved = frozenset(other.curves)
    names = [(name, rival) for name in one.curves for rival in RIVALS.get(name, ()) if rival in moved]
    return any(_meet(one, other, name, rival) for name, rival in names)


def _meet(one: LayerCurves, other: LayerCurves, name: str, rival: str) -> bool:
    mine = [(s.start, s.until) for s in one.steps if name in s.targets]
    theirs = [(s.start, s.until) for s in other.steps if rival in s.targets]
    return any(a < d and c < b for a, b in mine for c, d in theirs)
