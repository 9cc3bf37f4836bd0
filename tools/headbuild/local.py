"""How the surroundings of each vertex turn and grow from one face to another."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from risorius.core.arrays import AnyArray

_STIFF = 0.3  # share of an edge's length² by which a map is held: it decides across the surface
_SMOOTH = 30.0  # how far maps are evened out: about five edges, more than lips and lids are wide
_STRETCH = (0.75, 1.33)


def local_maps(before: AnyArray, after: AnyArray, edges: AnyArray, laplacian: sp.csr_matrix) -> AnyArray:
    """Linear maps (N0, 3, 3) that carry the edges about each vertex of `before` (N0, 3) to those of `after`
    best, evened out over the surface; none stretches by less or more than `_STRETCH`.
    """
    count = len(before)
    a, b = np.concatenate([edges, edges[:, ::-1]]).T
    old, new = before[b] - before[a], after[b] - after[a]
    normal, mixed = (_sums(a, part, old, count) for part in (old, new))
    hold = _STIFF * np.trace(normal, axis1=1, axis2=2)[:, None, None] * np.eye(3)
    maps = (mixed + hold) @ np.linalg.inv(normal + hold)
    even = splu((sp.identity(count) + _SMOOTH * laplacian).tocsc())
    smooth = even.solve(maps.reshape(count, 9)).reshape(count, 3, 3)
    u, stretch, v = np.linalg.svd(smooth)
    return np.asarray((u * np.clip(stretch, *_STRETCH)[:, None, :]) @ v)


def _sums(owner: AnyArray, left: AnyArray, right: AnyArray, count: int) -> AnyArray:
    """Sum of the outer products `left` x `right` (n, 3) by `owner` (n,)."""
    result = np.zeros((count, 3, 3))
    np.add.at(result, owner, left[:, :, None] * right[:, None, :])
    return result
