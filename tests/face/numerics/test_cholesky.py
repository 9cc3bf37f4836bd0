from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from risorius.face.numerics.cholesky import Factor, sparing_order
from risorius.face.numerics.stiffness import laplacian


def grid(side):
    corner = np.add.outer(side * np.arange(side - 1), np.arange(side - 1)).ravel()
    return np.stack([corner, corner + 1, corner + side + 1, corner + side], axis=1)


@pytest.mark.parametrize("side", [2, 5, 12])
def test_the_solution_solves(side):
    matrix = (laplacian(side * side, grid(side)) + 0.1 * sp.identity(side * side)).tocsc()
    order = sparing_order(matrix)
    assert sorted(order) == list(range(side * side))
    matrix = matrix[order][:, order].tocsc()
    given = np.random.default_rng(side).normal(size=(side * side, 4))
    solved = given.copy()
    Factor.of(matrix).solve(solved)
    np.testing.assert_allclose(matrix @ solved[:, :3], given[:, :3], atol=1e-10)


def test_the_order_is_sparing():
    matrix = (laplacian(400, grid(20)) + 0.1 * sp.identity(400)).tocsc()
    order = sparing_order(matrix)
    assert len(Factor.of(matrix[order][:, order].tocsc()).weight) < 0.7 * len(Factor.of(matrix).weight)
