import numpy as np
import pytest

from risorius.looks.attributes import MAX_CURVATURE
from risorius.render.subsurface import (
    ANGLES,
    CURVATURES,
    angle_place,
    curvature_place,
    diffuse_table,
    scattered,
    steepness,
)


@pytest.fixture(scope="module")
def table():
    return diffuse_table()


def test_flat_skin_follows_lambert(table):
    cosine = np.linspace(-1, 1, ANGLES)
    assert table[:, 0] == pytest.approx(np.repeat(np.maximum(cosine, 0)[:, None], 3, axis=1), abs=1e-6)


def test_light_is_spread_but_not_made(table):
    angle = np.arccos(np.linspace(-1, 1, ANGLES))
    for k in range(CURVATURES):
        around = 2 * np.trapezoid(table[:, k], -angle, axis=0)
        assert around == pytest.approx(2.0, rel=0.02)


def test_red_reaches_furthest_into_the_shade(table):
    red, green, blue = table[ANGLES // 2 - 3, CURVATURES - 1]
    assert red > 2 * green > 0
    assert green >= blue


def test_sharper_bends_glow_more(table):
    assert (np.diff(table[ANGLES // 2, :, 0]) > 0).all()


def look_up(table, cosine, curvature):
    return scattered(table, angle_place(np.float32(cosine)), curvature_place(np.float32(curvature)))


def test_looking_up_is_linear_and_clips(table):
    step = 2 / (ANGLES - 1)
    between = look_up(table, -1 + 60.5 * step, 0.0)
    assert between == pytest.approx(0.5 * (table[60, 0] + table[61, 0]), abs=1e-4)
    beyond = look_up(table, 2.0, 9 * MAX_CURVATURE)
    assert beyond == pytest.approx(table[-1, -1], abs=1e-3)


def test_no_entry_is_so_small_that_it_slows_the_processor(table):
    assert not ((table > 0) & (table < np.finfo(np.float32).tiny)).any()


@pytest.mark.parametrize("curvature", [0.0, 0.03, 0.11])
def test_steepness_is_what_a_cosine_adds(table, curvature):
    column, step = curvature_place(np.float32(curvature)), 0.25
    for row in (30.5, 60.5, 80.5):  # within a row of the table, where its light is linear
        low, high = (scattered(table, row + side * step, column)[1] for side in (-1, 1))
        cosines = 2 * step * 2 / (ANGLES - 1)
        assert steepness(table, np.float32(row), column) == pytest.approx((high - low) / cosines, abs=2e-3)
