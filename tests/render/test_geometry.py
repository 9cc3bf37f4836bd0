import numpy as np
import pytest

from risorius.face.rotations import head_rotation
from risorius.render.eyeball import cap
from risorius.render.geometry import Normals, triangles_as_faces, turn

POINTS = np.random.default_rng(1).normal(size=(50, 3)).astype(np.float32)
PIVOT = np.array([0.0, -4.0, -7.0], np.float32)


def turned(weight):
    rotation = head_rotation(10, 25, -5).astype(np.float32)
    out = np.zeros_like(POINTS)
    turn(POINTS, np.full(len(POINTS), weight, np.float32), rotation, PIVOT, out)
    return out, rotation


def test_no_share_of_the_rotation_leaves_points_where_they_are():
    assert np.array_equal(turned(0.0)[0], POINTS)


def test_the_whole_rotation_is_rigid_about_the_pivot():
    out, rotation = turned(1.0)
    assert out == pytest.approx((POINTS - PIVOT) @ rotation.T + PIVOT, abs=1e-5)


def test_normals_of_a_sphere_point_outwards():
    sphere, triangles = cap()
    points, normals = sphere.astype(np.float32), np.zeros((len(sphere), 3), np.float32)
    Normals(triangles_as_faces(triangles), len(sphere)).update(points, normals)
    inner = sphere[:, 2] > 0.3
    assert ((normals * sphere)[inner].sum(axis=1) > 0.995).all()


def test_a_quad_and_its_two_triangles_have_the_same_normal():
    points = np.array([[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0]], np.float32)
    for faces in ([[0, 1, 2, 3]], [[0, 1, 2, 2], [0, 2, 3, 3]]):
        normals = np.zeros((4, 3), np.float32)
        Normals(np.array(faces, np.int32), 4).update(points, normals)
        assert normals == pytest.approx(np.tile([0, 0, 1], (4, 1)))
