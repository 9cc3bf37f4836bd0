"""Products of matrices with points, in one thread and into existing memory.

A linear algebra library would start threads for each product, which costs more than the product.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import scipy.sparse as sp

from ...core.arrays import AnyArray, Array, FloatArray, IntArray, UInt32Array, UIntArray
from ...machine.kernels.jit import device, kernel
from .fours import added_times, four, row, set_row


def short(indices: IntArray) -> UIntArray:
    """Return `indices` in 16 bits if they fit, else in 32: shorter tables are faster to fetch."""
    return indices.astype(np.uint16 if indices.size == 0 or indices.max() < 1 << 16 else np.uint32)


class SparseRows(NamedTuple):
    """The rows of a sparse matrix (n, m): row i has `weight[start[i]:start[i + 1]]` at `column[…]`."""

    start: UInt32Array
    column: UIntArray
    weight: AnyArray

    @classmethod
    def of(cls, matrix: sp.csr_matrix, precision: type[np.floating[Any]] = np.float64) -> SparseRows:
        """Take the rows of a CSR matrix, with weights of a `precision`."""
        return cls(matrix.indptr.astype(np.uint32), short(matrix.indices), matrix.data.astype(precision))

    def times(self, points: Array, out: Array) -> Array:
        """Write the product with `points` (m, 4) to `out` (n, 4) and return it.

        Points are rows of x, y, z and an unused 0, so that a row fits a vector register.
        """
        _times(*self, points, out)
        return out


class QuantizedCsr(NamedTuple):
    """The rows of a sparse matrix (n, m) of few different weights: mostly, the `number` of one takes a byte.

    Row i has `weights[number[start[i]:start[i + 1]]]` at `column[…]`.
    """

    start: UInt32Array
    column: UIntArray
    number: UIntArray
    weights: Array

    @classmethod
    def of(cls, matrix: sp.csr_matrix) -> QuantizedCsr:
        """Take the rows of a CSR matrix."""
        weights, number = np.unique(matrix.data, return_inverse=True)
        start, column = matrix.indptr.astype(np.uint32), short(matrix.indices)
        if len(weights) > 256 or column.dtype != np.uint16:
            return cls(start, column.astype(np.uint32), number.astype(np.uint32), weights)
        return cls(start, column, number.astype(np.uint8), weights)

    def times(self, points: Array, out: Array) -> Array:
        """Write the product with `points` (m, 4) to `out` (n, 4) and return it, as `SparseRows` does."""
        _times_alike(*self, points, out)
        return out


@kernel(
    "u4[:], u2[:], f8[:], f8[:, 4], f8[:, 4]", "u4[:], u4[:], f8[:], f8[:, 4], f8[:, 4]", arithmetic="fast"
)
def _times(start: IntArray, column: UIntArray, weight: Array, points: Array, out: Array) -> None:
    for i in range(len(out)):
        total = four(0.0)
        for e in range(start[i], start[i + 1]):
            total = added_times(total, row(points, column[e]), weight[e])
        set_row(out, i, total)


@kernel(
    "u4[:], u2[:], u1[:], f8[:], f8[:, 4], f8[:, 4]",
    "u4[:], u4[:], u4[:], f8[:], f8[:, 4], f8[:, 4]",
    arithmetic="fast",
)
def _times_alike(
    start: IntArray, column: UIntArray, number: UIntArray, weights: Array, points: Array, out: Array
) -> None:
    for i in range(len(out)):
        total = four(0.0)
        for e in range(start[i], start[i + 1]):
            total = added_times(total, row(points, column[e]), weights[number[e]])
        set_row(out, i, total)


@kernel("f8[:, 4], f4[:, 3]")
def without_fourth(points: Array, out: FloatArray) -> None:
    """Copy `points` (n, 4) without their fourth column to `out` (n, 3), of any precision."""
    for v in range(len(out)):
        for c in range(3):
            out[v, c] = points[v, c]


@kernel("i4[:], f8[:, :], f8[:, :], f8[:, :], f8[:, :]", arithmetic="sums")
def carry(region: IntArray, motion: Array, moves: Array, sums: Array, skin: Array) -> None:
    """Add the transpose of `motion` (s, r) times `moves` (s, 4) to `skin` (N, 4) at `region` (r,).

    `sums` (3, r) is scratch.
    """
    for c in range(3):
        _clear(sums[c])
    # Four at a time, so that the sums are fetched and stored a quarter as often.
    even = len(moves) // 4 * 4
    for s in range(0, even, 4):
        for c in range(3):
            w, x, y, z = moves[s, c], moves[s + 1, c], moves[s + 2, c], moves[s + 3, c]
            if w != 0.0 or x != 0.0 or y != 0.0 or z != 0.0:
                for k in range(len(region)):
                    sums[c, k] += (
                        w * motion[s, k] + x * motion[s + 1, k] + y * motion[s + 2, k] + z * motion[s + 3, k]
                    )
    for s in range(even, len(moves)):
        for c in range(3):
            _add(moves[s, c], motion[s], sums[c])
    for k in range(len(region)):
        for c in range(3):
            skin[region[k], c] += sums[c, k]


@kernel("i4[:], f8[:, :], f8[:], f8[:], f8[:, :]", arithmetic="sums")
def carry_upwards(region: IntArray, motion: Array, pushes: Array, sums: Array, skin: Array) -> None:
    """Add `pushes` (s,), most of them 0, times `motion` (s, r) to the y of `skin` (N, 4) at `region` (r,).

    `sums` (r,) is scratch.
    """
    _clear(sums)
    for s in range(len(pushes)):
        push = pushes[s]
        if push != 0.0:
            for k in range(len(region)):
                sums[k] += push * motion[s, k]
    for k in range(len(region)):
        skin[region[k], 1] += sums[k]


@device()
def _clear(numbers: Array) -> None:
    for k in range(len(numbers)):
        numbers[k] = 0.0


@device("sums")
def _add(factor: float, numbers: Array, sums: Array) -> None:
    for k in range(len(sums)):
        sums[k] += factor * numbers[k]
