"""Layouts of creases on a face of the tables' size."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.face.head.face_coordinates import FaceCoordinates, plateau, ripple
from risorius.face.skin.wrinkle_layouts import Dimples, Fan, Fold, Lines

MARKS = FaceCoordinates(np.zeros((68, 3)), 1.0)
LINES = Lines(
    (0,), (0, 2, 0), (1, 0, 0), 3.0, 5.0, (1.0, 1.0, 1.0), (0, 1, 20, 21), (-20, -10, 10, 20), 0, 0, 0
)
FAN = Fan((0,), (1, 0, 0), (0, 1, 0), -20.0, 20.0, (1.0,) * 3, (-40, -30, 30, 40), (2, 4, 10, 20), 0, 0)
FOLD = Fold(((0, 5, 10), (0, 8, 0), (0, 5, -10)), (4.0, 8.0), (0.0, 0.1, 0.9, 1.0), (0, 0, 0))


def at(*points):
    return np.array(points, float)


def test_lines_have_integer_phase_on_every_crease():
    chart = LINES.chart(MARKS, at((0, 3, 0), (4, 8, 0), (-4, 13, 5)))
    np.testing.assert_allclose(chart.phase, [0.0, 1.0, 2.0])
    np.testing.assert_allclose(chart.mask, 1.0)
    np.testing.assert_allclose(chart.pull, [[0, 1, 0]] * 3)


def test_a_crease_that_the_table_lacks_is_not_there():
    assert LINES.chart(MARKS, at((0, 18, 0))).mask[0] == 0.0


def test_a_fan_radiates_and_is_compressed_round_its_centre():
    chart = FAN.chart(MARKS, at((6, 0, 0), (6 * np.cos(0.349066), 6 * np.sin(0.349066), 0), (1, 0, 0)))
    np.testing.assert_allclose(chart.phase[:2], [1.0, 2.0], atol=1e-5)
    assert chart.mask[2] == 0.0
    np.testing.assert_allclose(chart.pull[0], [0, 1, 0])


def test_a_fold_tells_its_sides_apart_and_tapers():
    chart = FOLD.chart(MARKS, at((8, 0, 0), (10, 0, 0), (6, 0, 0), (5, 10, 0), (17, 0, 0)))
    np.testing.assert_allclose(chart.phase[:3], [0.0, 0.25, -0.25], atol=0.02)
    assert chart.mask[0] == 1.0
    assert chart.mask[3] == chart.mask[4] == 0.0


def test_dimples_fill_an_ellipse():
    chart = Dimples((0,), -2.0, 3.0, (10.0, 5.0), "mentalis", 0.0).chart(
        MARKS, at((0, -2, 0), (11, -2, 0), (0, 4, 0))
    )
    np.testing.assert_allclose(chart.mask, [1.0, 0.0, 0.0])


def test_a_plateau_is_soft_between_its_edges():
    values = plateau((0, 2, 4, 8), np.array([-1.0, 0.0, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0]))
    np.testing.assert_allclose(values, [0, 0, 0.5, 1, 1, 1, 0.5, 0])


@pytest.mark.parametrize("seed", [1, 5])
def test_ripples_are_the_same_again_and_moderate(seed):
    points = np.random.default_rng(0).uniform(-100, 100, (500, 2))
    heights = ripple(points, 15.0, seed)
    np.testing.assert_array_equal(heights, ripple(points, 15.0, seed))
    assert 0.4 < heights.std() < 1.0
