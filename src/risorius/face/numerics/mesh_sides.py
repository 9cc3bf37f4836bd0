"""The sides of a mesh's quads, each once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import Int64Array, IntArray


class MeshSides(NamedTuple):
    """`ends` (E, 2), lower index first, in order; `of_corner` (Q, 4): the side that begins at each corner;
    `quads` (E,): how many quads a side belongs to.
    """

    ends: IntArray
    of_corner: Int64Array
    quads: Int64Array


def mesh_sides(quads: IntArray) -> MeshSides:
    """Return the sides of the mesh `quads` (Q, 4)."""
    numbers, beyond = _numbered(_around(quads))
    once, of_corner, counts = np.unique(numbers, return_inverse=True, return_counts=True)
    return MeshSides(_pairs(once, beyond, quads), of_corner.reshape(-1, 4), counts)


def edges(quads: IntArray) -> IntArray:
    """Return the ends (E, 2) of the sides of the mesh `quads` (Q, 4), each once, lower index first."""
    return unique_pairs(_around(quads))


def unique_pairs(pairs: IntArray) -> IntArray:
    """Return `pairs` (n, 2) each once whichever way round it is, lower index first, in order."""
    numbers, beyond = _numbered(pairs)
    return _pairs(np.unique(numbers), beyond, pairs)


def _around(quads: IntArray) -> IntArray:
    """Return the corners at both ends of each side of each quad (4 Q, 2)."""
    return np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)


def _numbered(pairs: IntArray) -> tuple[Int64Array, int]:
    """Return a number for each pair, and their base: numbers are sorted much faster than pairs."""
    ends = np.sort(pairs, axis=1).astype(np.int64)
    beyond = int(ends.max(initial=0)) + 1
    return ends[:, 0] * beyond + ends[:, 1], beyond


def _pairs(numbers: Int64Array, beyond: int, like: IntArray) -> IntArray:
    return np.column_stack(np.divmod(numbers, beyond)).astype(like.dtype)
