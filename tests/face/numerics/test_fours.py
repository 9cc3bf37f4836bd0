from __future__ import annotations

import numpy as np
import pytest

from risorius.face.numerics.fours import gathered, inverse_cube_root, spread


@pytest.mark.parametrize("x", [1.0, 1.0 + 1e-12, 1.9, 2.1, 7.9, 8.1, 1e3, 1e9, 1e30, 1e90, 1e-3, 1e-30])
def test_inverse_cube_roots_are_exact_to_13_digits(x: float) -> None:
    assert inverse_cube_root(x) * np.cbrt(x) == pytest.approx(1.0, abs=1e-13)


@pytest.mark.parametrize(("first", "last"), [(0, 0), (0, 1), (1, 4), (0, 6)])
def test_points_are_gathered_and_spread_by_weights(first: int, last: int) -> None:
    rng = np.random.default_rng(0)
    points, row, weight = rng.normal(size=(5, 4)), np.array([4, 1, 3, 1, 2, 4], np.uint16), rng.normal(size=6)
    some = slice(first, last)
    np.testing.assert_allclose(gathered(points, row, weight, first, last), weight[some] @ points[row[some]])
    expected = points.copy()
    np.subtract.at(expected, row[some], weight[some, None] * points[0])
    spread(points, 0, row, weight, first, last)
    np.testing.assert_allclose(points, expected)
