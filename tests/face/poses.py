"""Values of every parameter for what is measured: muscles together, and random combinations."""

from __future__ import annotations

import numpy as np

from risorius.core.parameters import INDEX, MUSCLES, NEUTRAL, RIVALS

BASES = tuple(dict.fromkeys(m.base for m in MUSCLES))
JAW = "masseter"


def contracted(bases):
    """Values (46,) with both sides of some muscles at 1."""
    values = np.array(NEUTRAL)
    for m in MUSCLES:
        if m.base in bases:
            values[INDEX[m.name]] = 1.0
    return values


def random_values(draw):
    """Values (46,) of a random combination free of conflicts: any number of muscles, 0 to 1."""
    values = np.array(NEUTRAL)
    chosen = set()
    for i in draw.permutation(len(MUSCLES))[: draw.integers(2, len(MUSCLES) + 1)]:
        name = MUSCLES[i].name
        if not chosen & set(RIVALS[name]):
            chosen.add(name)
            values[INDEX[name]] = draw.random()
    return values
