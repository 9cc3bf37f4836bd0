"""Roots that kernels compute often."""

from __future__ import annotations

import numpy as np

from ..core.kernels.jit import summing_device

# Subtracting a third of the bits of x from this gives 1/∛x within 4 %: the fast inverse root, for cubes.
_MAGIC = 0x553EF0FF289DD796


@summing_device
def inverse_cube_root(x: float) -> float:
    """Return 1/∛x for x ≥ 1, to 13 digits; twice as fast as the library's cube root.

    A guess from the bits of `x`, then a step of third and two of second order (Householder).
    """
    root = np.int64(_MAGIC - np.float64(x).view(np.int64) // 3).view(np.float64)
    error = 1.0 - x * root * root * root
    root *= 1.0 + error * (1.0 / 3.0 + error * (2.0 / 9.0))
    for _ in range(2):
        error = 1.0 - x * root * root * root
        root *= 1.0 + error * (1.0 / 3.0)
    return float(root)
