"""Light that enters the skin and leaves it elsewhere, precomputed for bent surfaces.

The profile of skin is a sum of Gaussians (d'Eon and Luebke, GPU Gems 3, 2007, table of chapter 14);
integrated over a ring of the surface's radius it gives the light at each angle (Penner, SIGGRAPH 2011): red
travels furthest, so the edge of a shadow on the skin is warm.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import Float32Array
from ..looks.attributes import MAX_CURVATURE
from ..machine.kernels.jit import device, f4, index
from ..machine.kernels.vec import Vec, bounded

_VARIANCES = np.array([0.0064, 0.0484, 0.187, 0.567, 1.99, 7.41])  # mm²
_WEIGHTS = np.array(
    [
        [0.233, 0.455, 0.649],
        [0.100, 0.336, 0.344],
        [0.118, 0.198, 0.0],
        [0.113, 0.007, 0.007],
        [0.358, 0.004, 0.0],
        [0.078, 0.0, 0.0],
    ]
)
ANGLES, CURVATURES = 96, 16
_NOTHING = 1e-6  # less counts as no light: subnormal numbers would be a hundred times slower
_ONE = index(1)


def _profile(distance: np.ndarray) -> np.ndarray:
    gauss = np.exp(-(distance[..., None] ** 2) / (2 * _VARIANCES)) / (2 * np.pi * _VARIANCES)
    return np.asarray(gauss @ _WEIGHTS)


def diffuse_table() -> Float32Array:
    """Return the light leaving skin, (ANGLES, CURVATURES, 3) float32.

    Rows run over the cosine between normal and light from −1 to 1, columns over curvature (1 / radius in mm)
    from 0 to MAX_CURVATURE, channels are red, green and blue; flat skin follows Lambert's law.
    """
    angle = np.arccos(np.linspace(-1.0, 1.0, ANGLES))
    ring = np.linspace(-np.pi, np.pi, 2881)
    lit = np.maximum(np.cos(angle[:, None] + ring), 0.0)
    table = np.empty((ANGLES, CURVATURES, 3), np.float32)
    table[:, 0] = np.maximum(np.cos(angle), 0.0)[:, None]
    for k in range(1, CURVATURES):
        radius = (CURVATURES - 1) / (k * MAX_CURVATURE)
        weight = _profile(2 * radius * np.abs(np.sin(ring / 2)))
        table[:, k] = lit @ weight / weight.sum(axis=0)
    table[table < _NOTHING] = 0.0
    return table


@device("fast")
def angle_place(cosine: float) -> float:
    """Return the row of the table, with its fraction, for the cosine between normal and light."""
    return bounded((cosine + f4(1)) * f4(0.5), f4(0.9999)) * f4(ANGLES - 1)


@device("fast")
def curvature_place(curvature: float) -> float:
    """Return the column of the table, with its fraction, for a curvature in 1/mm."""
    return bounded(curvature * f4(1 / MAX_CURVATURE), f4(0.9999)) * f4(CURVATURES - 1)


@device("fast")
def scattered(table: Float32Array, x: float, y: float) -> Vec:
    """Return the table's value at `angle_place` and `curvature_place`, interpolated linearly."""
    i, j = index(x), index(y)
    below, right = i + _ONE, j + _ONE
    u, v = x - f4(i), y - f4(j)
    a, b = (f4(1) - u) * (f4(1) - v), (f4(1) - u) * v
    c, d = u * (f4(1) - v), u * v
    return (
        a * table[i, j, 0] + b * table[i, right, 0] + c * table[below, j, 0] + d * table[below, right, 0],
        a * table[i, j, 1] + b * table[i, right, 1] + c * table[below, j, 1] + d * table[below, right, 1],
        a * table[i, j, 2] + b * table[i, right, 2] + c * table[below, j, 2] + d * table[below, right, 2],
    )


@device("fast")
def steepness(table: Float32Array, x: float, y: float) -> float:
    """Return how the table's green changes with the cosine at `angle_place` and `curvature_place`."""
    i, j = index(x), index(y)
    below, right, v = i + _ONE, j + _ONE, y - f4(j)
    here, there = table[below, j, 1] - table[i, j, 1], table[below, right, 1] - table[i, right, 1]
    steep: float = (here + (there - here) * v) * f4(0.5 * (ANGLES - 1))
    return steep
