"""How far a seal closes the lips: visemes and presets, which have no contact, show a closure by it."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..parameters import INDEX
from .lip_rig import OPENING, SEAL, LipRig, gap_left

TOUCHING, PARTED = 0.3, 1.2
"""mm of the rig up to which lips touch on the mesh from corner to corner, and from which on they are open."""
SOUGHT = 0.05
"""The seal from which on lips that touch are closed by it; below, they are more and more at rest."""


def closed_lips(rig: LipRig, values: Array) -> Array:
    """Return how far a seal closes the lips (n,): 1 where they touch by it, 0 where they stay open.

    `values` (n, 46) are those of all parameters.
    """
    seal = values[:, INDEX[SEAL]]
    gap = rig.gap({name: values[:, INDEX[name]] for name in OPENING})
    left = gap_left(np.maximum(gap, 0.0), seal)
    near = np.clip((PARTED - left) / (PARTED - TOUCHING), 0.0, 1.0)
    return np.asarray(near * np.minimum(seal / SOUGHT, 1.0))


def shut_lips(rig: LipRig, values: Array) -> Array:
    """Return by how much vowels are less (n,) 0..1: as the lips close, or as far as a seal is sought."""
    return np.maximum(closed_lips(rig, values), values[:, INDEX[SEAL]])
