from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.head.eyes import eye_rotations, pitch_and_yaw
from risorius.face.numerics.rotations import direction
from tests.profiles import examples

CENTRES = np.array([[30.0, 0.0, 0.0], [-30.0, 0.0, 0.0]])


@given(st.floats(-35.0, 35.0), st.floats(-45.0, 45.0), st.floats(0.1, 100.0))
@examples(40)
def test_both_eyes_look_at_the_same_point(pitch, yaw, metres):
    point = direction(pitch, yaw) * metres * 1000.0
    for rotation, centre in zip(eye_rotations(CENTRES, pitch, yaw, metres), CENTRES, strict=True):
        gaze, way = rotation[:, 2], point - centre
        np.testing.assert_allclose(np.cross(gaze, way), 0.0, atol=1e-6)
        assert gaze @ way > 0.0


def test_a_far_point_leaves_the_eyes_parallel_and_a_near_one_crosses_them():
    far, near = eye_rotations(CENTRES, 0.0, 0.0, 100.0), eye_rotations(CENTRES, 0.0, 0.0, 0.2)
    assert abs(pitch_and_yaw(far[0])[1]) < 0.02
    assert pitch_and_yaw(near[0])[1] == pytest.approx(-np.degrees(np.arctan2(30.0, 200.0)))
    assert pitch_and_yaw(near[1])[1] == pytest.approx(np.degrees(np.arctan2(30.0, 200.0)))


def test_pitch_is_up_and_yaw_is_to_the_subjects_left():
    pitch, yaw = pitch_and_yaw(eye_rotations(CENTRES, 20.0, 10.0, 100.0)[0])
    assert (pitch, yaw) == pytest.approx((20.0, 10.0), abs=0.05)
