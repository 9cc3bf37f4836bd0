"""The mean curvature of a mesh."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array, FloatArray, IntArray
from ..face.numerics.mesh_sides import edges


def mean_curvature(
    points: FloatArray,
    normals: FloatArray,
    quads: IntArray,
    rounds: int = 3,
) -> Array:
    """Return the size (n,) of the curvature in 1/mm: the change of the normals along edges, smoothed."""
    i, j = edges(quads).T
    length = np.linalg.norm(points[i] - points[j], axis=1)
    bend = np.linalg.norm(normals[i] - normals[j], axis=1) / np.maximum(length, 1e-3)
    ends, degree = np.concatenate([i, j]), np.bincount(np.concatenate([i, j]), minlength=len(points))
    degree = np.maximum(degree, 1)
    curvature = np.bincount(ends, np.concatenate([bend, bend]), len(points)) / degree
    for _ in range(rounds):
        around = np.bincount(ends, np.concatenate([curvature[j], curvature[i]]), len(points)) / degree
        curvature = 0.5 * (curvature + around)
    return curvature
