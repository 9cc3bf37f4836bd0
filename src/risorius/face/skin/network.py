"""The skin as a network of masses and springs (paper B, section 6.1; facts: face-model, section 4).

Every point has springs to its neighbours and one to its place at rest: K = k L + k₀ I over the edges of level
0. The muscles request a displacement d; their force is f = K d, so that at equilibrium a single muscle gives
exactly its calibrated field.

Points that no muscle moves stand still. The lips are quasi-static: they follow the muscles at once, so that
the mouth never closes late. Both form the border of the network.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ...core.arrays import Array, BoolArray, IndexArray, UInt32Array
from ...machine.kernels.jit import device, i8, kernel
from ..head.head import Head
from ..muscles.muscles import fields_of
from ..numerics.cholesky import Factor, sparing_order
from ..numerics.fours import added_times, gathered, set_row
from ..numerics.fours import row as row_at
from ..numerics.stiffness import spring_stiffness

STILL = 0.02  # mm at full contraction: a point that moves less counts as one that no muscle moves
LIP = 0.5  # a point whose mask is higher belongs to the lips


@dataclass(frozen=True, slots=True)
class Network:
    """The free points of a head's skin and the springs between them.

    `free` (r,) level-0 vertices in the order of the factor; row i of the stiffness (r, r) is
    `weight[start[i]:start[i + 1]]` at `column[…]`. `stiffness` is the same as a matrix.
    """

    free: IndexArray
    stiffness: sp.csc_matrix
    start: UInt32Array
    column: UInt32Array
    weight: Array

    @classmethod
    def of(cls, head: Head) -> Network:
        """Span the network over the skin of `head`."""
        free = np.flatnonzero(_moved(head) & ~_lips(head))
        whole = spring_stiffness(len(head.rest), head.quads).tocsr()
        free = free[sparing_order(whole[free][:, free].tocsc())]
        stiffness = whole[free][:, free].tocsr()
        return cls(
            free,
            stiffness.tocsc(),
            stiffness.indptr.astype(np.uint32),
            stiffness.indices.astype(np.uint32),
            stiffness.data.astype(np.float64),
        )

    def factor(self, stiffness: float, point: float) -> Factor:
        """Factor `stiffness` times K plus `point` times I."""
        return Factor.of((stiffness * self.stiffness + point * sp.identity(len(self.free))).tocsc())


def _moved(head: Head) -> BoolArray:
    moved = np.zeros(len(head.rest), bool)
    for row in fields_of(head):
        moved[row.field.vertices[np.linalg.norm(row.field.displacement, axis=1) > STILL]] = True
    return moved


def _lips(head: Head) -> BoolArray:
    return np.asarray(np.maximum(head.masks["lips"], head.masks["inner_mouth"]) > LIP)


@kernel("u4[:], u4[:], f8[:], f8[:, 4], f8, f8[:, 4]", arithmetic="sums")
def pull(
    start: UInt32Array, column: UInt32Array, weight: Array, points: Array, factor: float, out: Array
) -> None:
    """Add `factor` K times `points` (r, 4) to `out` (r, 4); the first three arguments as in `Network`."""
    add_pull(start, column, weight, points, factor, out)


@device("sums")
def add_pull(
    start: UInt32Array, column: UInt32Array, weight: Array, points: Array, factor: float, out: Array
) -> None:
    """Pull as `pull` does, within a kernel."""
    for i in range(len(out)):
        near = gathered(points, column, weight, i8(start[i]), i8(start[i + 1]))
        set_row(out, i, added_times(row_at(out, i), near, factor))
