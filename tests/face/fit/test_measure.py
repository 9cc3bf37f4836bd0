from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from risorius.face.fit.measure import Gauge, Measures

from ..conftest import EMOTIONS


@pytest.fixture(scope="module")
def measure(head, face):
    gauge = Gauge(head)
    return lambda **targets: gauge.measure(face(**targets))


def test_rest_measures_the_same_every_time(measure, face):
    first = measure()
    face(masseter=1.0, AU12=1.0)
    assert measure() == first
    assert first.lip_gap_mm == pytest.approx(0.0, abs=1e-5)
    assert first.jaw_drop_mm == pytest.approx(0.0, abs=1e-5)
    assert first.lip_protrusion_mm == pytest.approx(0.0, abs=1e-5)


def test_columns_are_in_the_order_of_the_contract():
    assert " ".join(f.name for f in dataclasses.fields(Measures)) == (
        "lip_gap_mm lip_protrusion_mm mouth_width_mm jaw_drop_mm eye_gap_left_mm eye_gap_right_mm "
        "brow_inner_left_mm brow_inner_right_mm brow_outer_left_mm brow_outer_right_mm "
        "head_pitch_deg head_yaw_deg head_roll_deg gaze_pitch_deg gaze_yaw_deg"
    )


def test_measures_move_the_way_of_their_muscles(measure):
    rest = measure()
    assert measure(masseter=0.5).jaw_drop_mm > 5.0
    assert measure(AU12=1.0).mouth_width_mm > rest.mouth_width_mm + 5.0
    assert measure(AU22=1.0).mouth_width_mm < rest.mouth_width_mm - 4.0
    assert measure(AU22=1.0).lip_protrusion_mm > 2.0
    assert measure(AU1=1.0).brow_inner_left_mm > rest.brow_inner_left_mm + 2.0
    assert measure(AU2=1.0).brow_outer_right_mm > rest.brow_outer_right_mm + 2.0
    assert measure(AU4=1.0).brow_inner_right_mm < rest.brow_inner_right_mm - 1.5
    assert measure(AU5=1.0).eye_gap_left_mm > rest.eye_gap_left_mm + 1.5


def test_closed_eyes_and_lips_measure_zero(measure):
    closed = measure(AU45=1.0, masseter=0.2, lip_seal=1.0)
    assert closed.lip_gap_mm < 0.05
    assert closed.eye_gap_left_mm == pytest.approx(0.0, abs=0.01)
    assert closed.eye_gap_right_mm == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("emotion", EMOTIONS)
def test_left_and_right_agree_in_symmetric_expressions(measure, emotion):
    m = measure(**EMOTIONS[emotion])
    assert m.eye_gap_left_mm == pytest.approx(m.eye_gap_right_mm, abs=0.05)
    assert m.brow_inner_left_mm == pytest.approx(m.brow_inner_right_mm, abs=0.05)
    assert m.brow_outer_left_mm == pytest.approx(m.brow_outer_right_mm, abs=0.05)


def test_one_side_alone_changes_that_side(measure):
    rest, wink = measure(), measure(**{"AU45.left": 1.0, "AU1.right": 1.0})
    assert wink.eye_gap_left_mm == pytest.approx(0.0, abs=0.01)
    assert wink.eye_gap_right_mm == pytest.approx(rest.eye_gap_right_mm, abs=0.2)
    assert wink.brow_inner_right_mm > rest.brow_inner_right_mm + 2.0
    assert wink.brow_inner_left_mm < rest.brow_inner_left_mm + 1.0


def test_the_heads_rotation_does_not_enter(measure):
    turned = measure(head_yaw=30.0, head_pitch=-10.0, AU12=0.5)
    plain = measure(AU12=0.5)
    assert dataclasses.replace(turned, head_yaw_deg=0.0, head_pitch_deg=0.0) == plain
    assert (turned.head_yaw_deg, turned.head_pitch_deg) == (30.0, -10.0)


def test_landmarks_lie_where_ibug_puts_them(head, face):
    points = Gauge(head).landmarks(face())
    assert points.shape == (68, 3)
    mirrored = points[[*range(16, -1, -1), *range(26, 16, -1)]] * [-1.0, 1.0, 1.0]
    np.testing.assert_allclose(points[:27], mirrored, atol=1.0)
    assert points[36, 0] < points[39, 0] < points[42, 0] < points[45, 0]
    assert points[30, 2] == points[27:36, 2].max()
    assert points[51, 1] > points[62, 1] >= points[66, 1] - 0.5 > points[57, 1]
