import numpy as np
import pytest

from risorius.face.numerics.rotations import head_rotation
from risorius.looks.surface import Surface, unit
from risorius.render.ribbons import NOTHING, WHOLE, ribbons

EYE = np.array([0.0, 0.0, 500.0], np.float32)


@pytest.fixture
def sheet():
    """A flat grid of 5 by 5 vertices, 10 mm apart, that faces the camera."""
    x, y = np.meshgrid(np.arange(5) * 10.0 - 20, np.arange(5) * 10.0 - 20)
    points = np.stack([x.ravel(), y.ravel(), np.zeros(25)], axis=1)
    corner = np.array([r * 5 + c for r in range(4) for c in range(4)])
    triangles = np.concatenate([corner[:, None] + [0, 1, 6], corner[:, None] + [0, 6, 5]]).astype(np.int32)
    return Surface(points, np.tile([0.0, 0.0, 1.0], (25, 1)), triangles)


@pytest.fixture
def hairs(sheet):
    triangles, weights = sheet.nearest(np.array([[3.0, 4.0, 0.0], [-12.0, 7.5, 0.0]]))
    origin, _ = sheet.at(triangles, weights)
    curves = origin[:, None, :] + np.array([[0, 0, 0], [1, 2, 1], [2, 5, 1.5]])
    return sheet.root(triangles, weights, curves, np.full((2, 3), 0.4), np.ones((2, 3)), np.zeros(2), 0.5)


def drawn(points, normals, hairs, eye=EYE, least=0.0, shown=None):
    positions = np.zeros((len(points) + hairs.vertices, 3), np.float32)
    directions = np.zeros_like(positions)
    positions[: len(points)], directions[: len(points)] = points, normals
    shown = np.array([WHOLE] * len(hairs.roots) if shown is None else shown, np.int8)
    limits = (np.float32(hairs.behind), np.float32(least))
    shape = (hairs.roots, hairs.weights, hairs.curves, hairs.widths)
    ribbons(positions, directions, *shape, shown, eye, len(points), *limits)
    strands = positions[len(points) :].reshape(len(hairs.widths), -1, 2, 3)
    return strands, directions[len(points) :].reshape(strands.shape)


def test_at_rest_a_hair_lies_where_it_was_drawn(sheet, hairs):
    strands, _ = drawn(sheet.points, sheet.normals, hairs)
    middle = strands.mean(axis=2)
    expected = middle[:, :1] + np.array([[0, 0, 0], [1, 2, 1], [2, 5, 1.5]])
    assert middle == pytest.approx(expected, abs=1e-5)
    assert middle[0, 0] == pytest.approx([3, 4, 0], abs=1e-5)


def test_a_hair_that_is_not_shown_has_no_width_or_length(sheet, hairs):
    strands, directions = drawn(sheet.points, sheet.normals, hairs, shown=(NOTHING, WHOLE))
    assert np.ptp(strands[0].reshape(-1, 3), axis=0) == pytest.approx(0)
    assert not directions[0].any()
    assert np.ptp(strands[1, :, 0, 1]) > 4


def test_of_a_hair_only_what_is_shown_has_a_length(sheet, hairs):
    whole, _ = drawn(sheet.points, sheet.normals, hairs)
    strands, directions = drawn(sheet.points, sheet.normals, hairs, shown=((0, 1), (1, 2)))
    assert (strands[0] == whole[0][[0, 1, 1]]).all()
    assert (strands[1] == whole[1][[1, 1, 2]]).all()
    assert (directions.any(axis=(2, 3)) == [[True, True, False], [False, True, True]]).all()


def test_hairs_ride_rigidly_on_a_moved_surface(sheet, hairs):
    rotation, shift = head_rotation(20, -30, 10), np.array([4.0, -2.0, 9.0])
    rest, _ = drawn(sheet.points, sheet.normals, hairs)
    moved, _ = drawn(sheet.points @ rotation.T + shift, sheet.normals @ rotation.T, hairs)
    assert moved.mean(axis=2) == pytest.approx(rest.mean(axis=2) @ rotation.T + shift, abs=1e-4)


def test_ribbons_face_the_camera_at_full_width(sheet, hairs):
    strands, directions = drawn(sheet.points, sheet.normals, hairs)
    across = strands[:, :, 1] - strands[:, :, 0]
    assert np.linalg.norm(across, axis=-1) == pytest.approx(np.full((2, 3), 0.4), abs=1e-5)
    view = unit(EYE - strands.mean(axis=2))
    assert np.abs((unit(across) * view).sum(axis=-1)).max() < 1e-3
    assert np.abs((across * directions[:, :, 0]).sum(axis=-1)).max() < 1e-4


def test_hairs_behind_the_head_are_left_out(sheet, hairs):
    strands, directions = drawn(sheet.points, -sheet.normals, hairs)
    assert np.ptp(strands, axis=(1, 2)).max() < 1e-5
    assert (directions == 0).all()


def test_of_hairs_that_must_be_widened_some_are_left_out(sheet):
    rng = np.random.default_rng(2)
    triangles, weights = sheet.nearest(np.column_stack([rng.uniform(-15, 15, (400, 2)), np.zeros(400)]))
    origin, _ = sheet.at(triangles, weights)
    curves = origin[:, None, :] + np.array([[0, 0, 0], [1, 2, 1], [2, 5, 1.5]])
    fine = sheet.root(
        triangles, weights, curves, np.full((400, 3), 0.1), np.ones((400, 3)), np.zeros(400), 0.5
    )
    strands, _ = drawn(sheet.points, sheet.normals, fine, least=0.25)
    wide = np.linalg.norm(strands[:, 0, 1] - strands[:, 0, 0], axis=1)
    assert set(np.round(wide, 4)) == {0.0, 0.25}
    assert (wide > 0).mean() == pytest.approx(0.4, abs=0.02)
