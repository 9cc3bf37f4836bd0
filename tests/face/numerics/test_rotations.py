from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.numerics.rotations import about_axis, direction, forward_rows, head_rotation, turned
from tests.profiles import examples

degrees = st.floats(-60.0, 60.0)


def assert_rotation(matrix):
    np.testing.assert_allclose(matrix @ matrix.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(matrix) == pytest.approx(1.0)


@given(degrees, degrees, degrees)
@examples(30)
def test_all_are_rotations(a, b, c):
    assert_rotation(head_rotation(a, b, c))
    assert_rotation(np.array(forward_rows(*direction(a, b))))
    assert_rotation(about_axis(direction(a, b), c))


@given(degrees, degrees)
@examples(30)
def test_forward_rows_take_the_eye_to_its_target_without_torsion(pitch, yaw):
    target = direction(pitch, yaw)
    rotation = np.array(forward_rows(*target))
    np.testing.assert_allclose(rotation @ [0.0, 0.0, 1.0], target, atol=1e-12)
    axis = np.array(
        [rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]
    )
    assert axis[2] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("angles", "moved", "towards"),
    [
        ((10.0, 0.0, 0.0), (0, 0, 1), (0, 1, 0)),  # the nose goes up
        ((0.0, 10.0, 0.0), (0, 0, 1), (1, 0, 0)),  # the nose goes to the subject's left
        ((0.0, 0.0, 10.0), (0, 1, 0), (1, 0, 0)),  # the crown goes to the subject's left
    ],
)
def test_positive_angles_of_the_head(angles, moved, towards):
    assert (head_rotation(*angles) @ moved) @ towards == pytest.approx(np.sin(np.radians(10.0)))


def test_rotation_about_an_axis_keeps_the_axis_and_turns_by_the_angle():
    axis = np.array([0.6, 0.0, 0.8])
    rotation = about_axis(axis, 0.3)
    np.testing.assert_allclose(rotation @ axis, axis, atol=1e-15)
    assert np.trace(rotation) == pytest.approx(1.0 + 2.0 * np.cos(0.3))


def test_vectors_are_turned_each_by_its_own_angle():
    vectors = np.array([[1.0, 2.0, 3.0], [0.5, -1.0, 2.0]])
    axis = np.array([0.6, 0.0, 0.8])
    found = turned(vectors, axis, np.array([0.4, -1.1]))
    np.testing.assert_allclose(found[0], about_axis(axis, 0.4) @ vectors[0])
    np.testing.assert_allclose(found[1], about_axis(axis, -1.1) @ vectors[1])
    np.testing.assert_allclose(turned(vectors, axis, 0.0), vectors)
