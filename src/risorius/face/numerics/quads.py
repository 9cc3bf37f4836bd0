"""Geometry of meshes of quads."""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, IntArray


def quad_normals(points: Array, quads: IntArray) -> Array:
    """Return the unit normals (n, 3) of `points` (n, 3) of `quads` (q, 4); points of no quad have zeros."""
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    across = np.cross(c - a, d - b)
    normals = np.zeros_like(points)
    for corner in quads.T:
        np.add.at(normals, corner, across)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12))
