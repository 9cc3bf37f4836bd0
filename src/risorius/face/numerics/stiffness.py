"""The stiffness of the skin's springs: K = k L + k₀ I over a mesh's edges (facts: face-model, section 4)."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from ...core.arrays import IntArray
from .mesh_sides import edges

NEIGHBOUR, REST = 1.0, 0.1  # stiffness k of the springs between points, and k₀ of those to the rest


def spring_stiffness(count: int, quads: IntArray) -> sp.csc_matrix:
    """Return K (count, count) of the mesh `quads` (Q, 4)."""
    return (NEIGHBOUR * laplacian(count, quads) + REST * sp.identity(count)).tocsc()


def laplacian(count: int, quads: IntArray) -> sp.csr_matrix:
    """Return L (count, count) over the edges of the mesh `quads` (Q, 4)."""
    ends = edges(quads)
    ones = np.ones(2 * len(ends))
    beside = sp.csr_matrix((ones, (ends.ravel(), ends[:, ::-1].ravel())), shape=(count, count))
    return sp.diags(np.asarray(beside.sum(axis=1)).ravel()) - beside
