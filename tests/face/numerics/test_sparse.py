from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from risorius.face.numerics.sparse import QuantizedCsr, SparseRows, carry, carry_upwards, without_fourth

RNG = np.random.default_rng(7)


def test_rows_times_points_is_the_matrix_product():
    matrix = sp.random(40, 30, density=0.2, format="csr", random_state=3)
    points, out = RNG.normal(size=(30, 4)), np.full((40, 4), np.nan)
    assert SparseRows.of(matrix).times(points, out) is out
    np.testing.assert_allclose(out, matrix @ points, atol=1e-14)


@pytest.mark.parametrize("different", [3, 300])
def test_rows_of_few_weights_give_the_same_bytes(different):
    matrix = sp.random(40, 30, density=0.4, format="csr", random_state=3)
    matrix.data = RNG.choice(RNG.normal(size=different), len(matrix.data))
    points = RNG.normal(size=(30, 4))
    alike, sparse = (rows.of(matrix).times(points, np.empty((40, 4))) for rows in (QuantizedCsr, SparseRows))
    assert alike.tobytes() == sparse.tobytes()


def test_the_fourth_column_is_left_out():
    points, out = RNG.normal(size=(5, 4)), np.full((5, 3), np.nan, np.float32)
    without_fourth(points, out)
    np.testing.assert_array_equal(out, points[:, :3].astype(np.float32))


def test_carry_adds_the_motion_of_every_handle_to_its_region_alone():
    skin, region = RNG.normal(size=(12, 3)), np.array([1, 4, 7], np.int32)
    motion, moves = RNG.normal(size=(9, 3)), RNG.normal(size=(9, 3))
    moves[:4, 0] = 0.0
    expected = skin.copy()
    expected[region] += motion.T @ moves
    carry(region, motion, moves, np.full((3, 3), np.nan), skin)
    np.testing.assert_allclose(skin, expected, atol=1e-14)


def test_carry_upwards_moves_y_alone():
    skin, region = RNG.normal(size=(12, 3)), np.array([1, 4, 7], np.int32)
    motion, pushes = RNG.normal(size=(5, 3)), np.array([0.0, 1.0, 0.0, -2.0, 0.0])
    expected = skin.copy()
    expected[region, 1] += pushes @ motion
    carry_upwards(region, motion, pushes, np.full(3, np.nan), skin)
    np.testing.assert_allclose(skin, expected, atol=1e-14)
