import numpy as np
import pytest

from risorius.looks.surface import Surface, flat, unit


@pytest.fixture
def sheet():
    """A flat grid of 5 by 5 vertices, 10 mm apart, that faces the camera."""
    x, y = np.meshgrid(np.arange(5) * 10.0 - 20, np.arange(5) * 10.0 - 20)
    points = np.stack([x.ravel(), y.ravel(), np.zeros(25)], axis=1)
    corner = np.array([r * 5 + c for r in range(4) for c in range(4)])
    triangles = np.concatenate([corner[:, None] + [0, 1, 6], corner[:, None] + [0, 6, 5]]).astype(np.int32)
    return Surface(points, np.tile([0.0, 0.0, 1.0], (25, 1)), triangles)


def test_the_nearest_place_of_a_point_on_the_surface_is_that_point(sheet):
    places = np.array([[3.3, -7.1, 0.0], [19.0, 19.5, 0.0]])
    triangles, weights = sheet.nearest(places)
    assert sheet.at(triangles, weights)[0] == pytest.approx(places, abs=1e-9)
    assert weights.sum(axis=1) == pytest.approx([1, 1])


def test_a_place_off_the_surface_falls_on_its_border(sheet):
    triangles, weights = sheet.nearest(np.array([[50.0, 0.0, 5.0]]))
    assert sheet.at(triangles, weights)[0][0] == pytest.approx([20, 0, 0], abs=1e-9)


def test_flat_vectors_lie_in_the_plane():
    normal = unit(np.array([[1.0, 2.0, 3.0]]))
    found = flat(np.array([[0.3, -0.2, 0.9]]), normal)
    assert (found * normal).sum() == pytest.approx(0, abs=1e-12)
    assert np.linalg.norm(found) == pytest.approx(1)
