import numpy as np
import pytest

from risorius.face.numerics.rotations import head_rotation
from risorius.render.turn import turn

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
