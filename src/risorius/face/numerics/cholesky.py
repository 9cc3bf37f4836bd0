"""A sparse symmetric matrix that is factored once and solved many times for points, in one thread.

The unknowns have the order of the factor (minimum degree), so that solving needs no permutation. Points are
rows of four (x, y, z and an unused 0), so that a row fits a vector register and no row crosses a line of
the cache. Indices are unsigned, because numba checks signed ones for negative values.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from ...core.arrays import Array, IndexArray, UInt32Array, UIntArray
from ...machine.kernels.jit import device, i8, kernel
from .fours import gathered, set_row, spread
from .fours import row as row_at
from .sparse import short

_SYMMETRIC = {"options": {"SymmetricMode": True}, "diag_pivot_thresh": 0.0}


@dataclass(frozen=True, slots=True)
class Factor:
    """L D Lᵀ of a positive definite matrix (n, n): the columns of L below its unit diagonal, and 1 / D.

    Column j is `weight[start[j]:start[j + 1]]` at the rows `row[…]`; `inverse` (n,).
    """

    start: UInt32Array
    row: UIntArray
    weight: Array
    inverse: Array

    @classmethod
    def of(cls, matrix: sp.csc_matrix) -> Factor:
        """Factor `matrix` without changing the order of its unknowns."""
        factor = splu(matrix.tocsc(), permc_spec="NATURAL", **_SYMMETRIC)
        lower = sp.tril(factor.L, -1).tocsc()
        lower.sort_indices()
        return cls(
            lower.indptr.astype(np.uint32),
            short(lower.indices),
            lower.data.copy(),
            1.0 / factor.U.diagonal(),
        )

    def solve(self, points: Array) -> None:
        """Replace each column of `points` (n, 4) by its solution, in place."""
        solve(self.start, self.row, self.weight, self.inverse, points)


def sparing_order(matrix: sp.csc_matrix) -> IndexArray:
    """Return the order (n,) of the unknowns of a symmetric `matrix` that keeps its factor sparse."""
    factor = splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", **_SYMMETRIC)
    return np.argsort(factor.perm_c)


@kernel("u4[:], u2[:], f8[:], f8[:], f8[:, 4]", "u4[:], u4[:], f8[:], f8[:], f8[:, 4]", arithmetic="sums")
def solve(start: UInt32Array, row: UIntArray, weight: Array, inverse: Array, points: Array) -> None:
    """Solve L D Lᵀ x = b for each column of `points` (n, 4); the first four arguments as in `Factor`."""
    substitute(start, row, weight, inverse, points)


@device("sums")
def substitute(start: UInt32Array, row: UIntArray, weight: Array, inverse: Array, points: Array) -> None:
    """Solve as `solve` does, within a kernel."""
    count = len(inverse)
    for j in range(count):
        spread(points, j, row, weight, i8(start[j]), i8(start[j + 1]))
    for j in range(count - 1, -1, -1):
        below = gathered(points, row, weight, i8(start[j]), i8(start[j + 1]))
        own, by = row_at(points, j), inverse[j]
        solved = (
            own[0] * by - below[0],
            own[1] * by - below[1],
            own[2] * by - below[2],
            own[3] * by - below[3],
        )
        set_row(points, j, solved)
