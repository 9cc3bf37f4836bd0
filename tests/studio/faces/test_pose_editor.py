"""Dials: the face that is asked for, and the skin's way there."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.api import pose
from risorius.core.parameters import INDEX, NAMES, NEUTRAL
from risorius.errors import ParameterError
from risorius.face.head.head import load_head
from risorius.face.solve import FaceSolver
from risorius.studio.faces.pose_editor import PoseEditor, dialled


@pytest.fixture(scope="module")
def dial():
    return PoseEditor(FaceSolver(load_head()))


@pytest.mark.parametrize("values", [{"AU99": 1.0}, {"zygomatic": 1.0}, {"masseter": 1.5}, {"AU1": -0.1}])
def test_what_cannot_be_dialled_is_named(values):
    with pytest.raises(ParameterError):
        dialled(values, {})


def test_a_dialled_face_is_the_pose_of_the_command_line():
    values, emotions = {"AU12": 0.4, "head_yaw": -10.0, "masseter": 0.2}, {"joy": 0.6, "surprise": 0.3}
    held = pose(values, emotion=emotions).performance.values[0]
    assert dialled(values, emotions) == pytest.approx(dict(zip(NAMES, held.tolist(), strict=True)))


def test_the_skin_starts_at_rest_overshoots_and_comes_to_the_face_asked_for(dial):
    values = np.array(NEUTRAL)
    first = dial.still(values)
    values[INDEX["zygomatic_major.left"]] = 1.0
    way = [np.abs(dial.moved(values, 1 / 120).skin - first.skin).max() for _ in range(100)]
    there = dial.still(values)
    full = np.abs(there.skin - first.skin).max()
    assert np.diff([0.0, *way]).max() < 0.25 * full
    assert 1.01 * full < max(way) < 1.1 * full
    assert way[-1] == pytest.approx(full, abs=0.01)


def test_a_long_wait_moves_the_skin_no_further_than_the_longest_step(dial):
    values = np.array(NEUTRAL)
    dial.still(values)
    dial.moved(values, 0.0)
    assert np.isfinite(dial.moved(values, 1e6).skin).all()
