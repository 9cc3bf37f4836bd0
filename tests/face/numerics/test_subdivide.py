from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.numerics.subdivide import catmull_clark, triangulate
from tests.profiles import examples

CUBE = np.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
CUBE_QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def grid(width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(np.arange(width + 1.0), np.arange(height + 1.0))
    points = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    corner = np.arange(x.size).reshape(height + 1, width + 1)
    quads = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=-1)
    return points, quads.reshape(-1, 4)


def volume(points: np.ndarray, triangles: np.ndarray) -> float:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float((np.cross(a, b) * c).sum() / 6.0)


def test_cube_has_the_counts_and_points_of_the_rule() -> None:
    fine = catmull_clark(8, CUBE_QUADS)
    points = fine.matrix @ CUBE
    assert fine.matrix.shape == (8 + 12 + 6, 8)
    assert fine.quads.shape == (24, 4)
    # A corner of valence 3 goes to (F + 2 R) / 3, with F = 1/3 and R = 2/3 of it; an edge to (E + F) / 2.
    assert np.abs(points[:8]) == pytest.approx(np.full((8, 3), 5.0 / 9.0))
    assert np.sort(np.abs(points[8:20]), axis=1) == pytest.approx(np.tile([0.0, 0.75, 0.75], (12, 1)))
    assert np.sort(np.abs(points[20:]), axis=1) == pytest.approx(np.tile([0.0, 0.0, 1.0], (6, 1)))


def test_winding_is_kept() -> None:
    fine = catmull_clark(8, CUBE_QUADS)
    coarse = volume(CUBE, triangulate(CUBE_QUADS))
    assert np.sign(volume(fine.matrix @ CUBE, fine.triangles)) == np.sign(coarse)


def test_border_follows_the_cubic_spline() -> None:
    points, quads = grid(4, 2)
    fine = catmull_clark(len(points), quads).matrix @ points
    assert fine[2] == pytest.approx([2.0, 0.0, 0.0])
    assert fine[0] == pytest.approx([0.125, 0.125, 0.0])


@examples(20)
@given(st.integers(1, 5), st.integers(1, 5), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_rows_sum_to_one_and_planes_stay_planes(width: int, height: int, slope: float, lift: float) -> None:
    points, quads = grid(width, height)
    points[:, 2] = slope * points[:, 0] - points[:, 1] + lift
    fine = catmull_clark(len(points), quads)
    assert np.asarray(fine.matrix.sum(axis=1)).ravel() == pytest.approx(np.ones(fine.matrix.shape[0]))
    refined = fine.matrix @ points
    assert refined[:, 2] == pytest.approx(slope * refined[:, 0] - refined[:, 1] + lift, abs=1e-9)


@examples(20)
@given(st.integers(1, 4), st.integers(1, 4))
def test_every_fine_edge_of_the_inside_belongs_to_two_faces(width: int, height: int) -> None:
    points, quads = grid(width, height)
    fine = catmull_clark(len(points), quads)
    sides = np.sort(np.stack([fine.quads, np.roll(fine.quads, -1, axis=1)], -1).reshape(-1, 2), axis=1)
    counts = np.unique(sides, axis=0, return_counts=True)[1]
    assert (counts == 1).sum() == 4 * (width + height)
    assert counts.max() == (2 if width * height > 0 else 1)


def test_triangles_of_a_quad_come_together() -> None:
    assert triangulate(np.array([[5, 6, 7, 8]])).tolist() == [[5, 6, 7], [5, 7, 8]]
