"""The sides of a mesh, against numpy's own way of finding rows that differ."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from risorius.core.arrays import IntArray
from risorius.face.numerics.mesh_sides import edges, mesh_sides, unique_pairs

KINDS = st.sampled_from([np.int32, np.int64])


def _rows(width: int) -> st.SearchStrategy[IntArray]:
    return KINDS.flatmap(
        lambda kind: arrays(kind, st.tuples(st.integers(0, 12), st.just(width)), elements=st.integers(0, 9))
    )


@given(_rows(2))
def test_pairs_are_those_that_numpy_finds(pairs: IntArray) -> None:
    found = unique_pairs(pairs)
    assert found.dtype == pairs.dtype
    np.testing.assert_array_equal(found, np.unique(np.sort(pairs, axis=1), axis=0))


@given(_rows(4))
def test_sides_lead_back_to_the_quads(quads: IntArray) -> None:
    sides = mesh_sides(quads)
    np.testing.assert_array_equal(sides.ends, edges(quads))
    around = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    np.testing.assert_array_equal(sides.ends[sides.of_corner.ravel()], np.sort(around, axis=1))
    counts = np.bincount(sides.of_corner.ravel(), minlength=len(sides.ends))
    np.testing.assert_array_equal(sides.quads, counts)
