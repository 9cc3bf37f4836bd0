"""The skin as a bending plate on a soft bed: how pushes at some points move the skin around them.

K = ½L² + 0.05L + 0.004I on the level-0 edges (facts: face-model, section 5), factored once per head.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu
from scipy.spatial import cKDTree

from ...core.arrays import Array, BoolArray, Int32Array, IntArray
from ...machine.array_cache import cached_arrays
from ..numerics.mesh_sides import edges

BENDING, STRETCHING, BED = 0.5, 0.05, 0.004
REACH = 45.0  # mm from a push; farther vertices do not move
# Vertices that every push moves by less than this share of the strongest response do not move.
NEGLIGIBLE = 0.004


@dataclass(frozen=True, slots=True)
class PlateCompliance:
    """The effects of unit pushes at n points.

    `region` (r,): the level-0 vertices that move; `motion` (n, r): how far each moves per unit push at each
    point; `compliance` (n, n): how far each point moves per unit push at each point.
    """

    region: Int32Array
    motion: Array
    compliance: Array


def stiffness(count: int, quads: IntArray) -> sp.csc_matrix:
    """Return K (count, count) of the mesh `quads` (Q, 4)."""
    ends = edges(quads)
    ones = np.ones(2 * len(ends))
    beside = sp.csr_matrix((ones, (ends.ravel(), ends[:, ::-1].ravel())), shape=(count, count))
    laplacian = sp.diags(np.asarray(beside.sum(axis=1)).ravel()) - beside
    return (BENDING * laplacian @ laplacian + STRETCHING * laplacian + BED * sp.identity(count)).tocsc()


def plate_compliance(quads: IntArray, points: sp.csr_matrix, free: BoolArray) -> PlateCompliance:
    """Return the response of the plate of `quads` (Q, 4) at `points` (n, N0), rows of weights that sum to 1.

    Only vertices in `free` (N0,) move; all vertices near the points must be among them.
    """
    inputs = quads, points.data, points.indices, points.indptr, free
    return PlateCompliance(
        *cached_arrays("response", inputs, lambda: _respond(stiffness(len(free), quads), points, free))
    )


def _respond(stiff: sp.csc_matrix, points: sp.csr_matrix, free: BoolArray) -> tuple[Int32Array, Array, Array]:
    local = np.flatnonzero(free)
    symmetric = {"SymmetricMode": True}
    part = stiff[local][:, local]
    factor = splu(part, permc_spec="MMD_AT_PLUS_A", options=symmetric, diag_pivot_thresh=0.0)
    weights = points[:, local]
    under = np.flatnonzero(weights.getnnz(axis=0))
    unit = np.zeros((len(local), len(under)))
    unit[under, np.arange(len(under))] = 1.0
    motion = factor.solve(unit)
    reach = np.abs(motion).max(axis=1)
    moved = np.flatnonzero(reach > NEGLIGIBLE * reach.max())
    at_points = weights[:, under]
    motion = motion @ at_points.T.toarray()
    compliance = weights @ motion
    region = local[moved].astype(np.int32)
    return region, np.ascontiguousarray(motion[moved].T), 0.5 * (compliance + compliance.T)


def nearby(rest: Array, points: Array) -> BoolArray:
    """Return which vertices `rest` (N0, 3) lie within a push's reach of any of `points` (n, 3)."""
    return np.asarray(cKDTree(points).query(rest, distance_upper_bound=REACH)[0] < REACH)
