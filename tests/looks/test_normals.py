import numpy as np
import pytest

from risorius.looks.eyeball import cap
from risorius.looks.normals import Normals, triangles_as_faces


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
