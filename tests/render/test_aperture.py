import numpy as np
import pytest

from risorius.render.aperture import lid_margins, lip_edges
from risorius.render.materials.eye import LID_STEPS
from risorius.render.materials.mouth import LIP_STEPS, past_lips, spread_in_flesh

IDENTITY, ORIGIN = np.eye(3, dtype=np.float32), np.zeros(3, np.float32)


def lips(gap):
    """Pairs of a mouth of 40 mm that opens by `gap` in its middle."""
    x = np.linspace(-20, 20, 21)
    half = 0.5 * gap * (1 - (x / 20) ** 2)
    upper, lower = np.stack([x, half, 0 * x], axis=1), np.stack([x, -half, 0 * x], axis=1)
    return np.stack([upper, lower], axis=1)


def share(gap, place):
    span, edges = lip_edges(lips(gap))
    arrays = (edges.astype(np.float32), span.astype(np.float32))
    return past_lips(IDENTITY, ORIGIN, *arrays, tuple(np.float32(v) for v in place))


def test_the_slit_follows_the_lips():
    span, edges = lip_edges(lips(10.0))
    assert edges.shape == (LIP_STEPS, 4)
    assert span == pytest.approx([-20, 20])
    assert edges[LIP_STEPS // 2, 0] == pytest.approx(5, abs=0.5)
    assert edges[LIP_STEPS // 2, 2] == pytest.approx(-5, abs=0.5)
    assert edges[0, 0] - edges[0, 2] < 2.5
    assert edges == pytest.approx(edges[::-1], abs=1e-6)


def test_no_light_passes_shut_lips():
    assert share(0.0, (0, 0, -6)) == pytest.approx(0, abs=1e-6)


def test_light_falls_with_depth_and_rises_with_the_opening():
    by_depth = [share(12.0, (0, 0, -z)) for z in (2, 5, 10, 20, 34)]
    assert (np.diff(by_depth) < 0).all()
    assert by_depth[-1] < 0.1
    # No mouth is deeper than its fauces, wherever its lining is drawn.
    assert share(12.0, (0, 0, -40)) == share(12.0, (0, 0, -60)) <= by_depth[-1]
    by_gap = [share(gap, (0, 0, -10)) for gap in (1, 3, 8, 20)]
    assert (np.diff(by_gap) > 0).all()


def test_light_is_scarcer_beside_and_above_the_opening():
    middle = share(12.0, (0, 0, -10))
    assert share(12.0, (28, 0, -10)) < 0.5 * middle
    assert share(12.0, (0, 12, -10)) < 0.5 * middle


def test_lid_margins_are_heights_over_the_eye():
    x = np.linspace(-10, 10, 9)
    upper = np.stack([x, np.full(9, 4.0), np.full(9, 11.0)], axis=1)
    lower = np.stack([x, np.full(9, -5.0), np.full(9, 11.0)], axis=1)
    centre = np.array([29.0, 0.0, 0.0])
    span, heights = lid_margins(np.stack([upper, lower], axis=1) + centre, centre, 12.0)
    assert heights.shape == (LID_STEPS, 2)
    assert span[0] == pytest.approx(-span[1])
    assert (heights[:, 0] > 3).all()
    assert (heights[:, 1] < -3.5).all()
    assert heights == pytest.approx(heights[::-1], abs=1e-9)


def test_flesh_that_no_light_reaches_past_the_lips_is_dim_and_not_black():
    assert 0.05 < spread_in_flesh(np.float32(0)) < 0.2
    assert spread_in_flesh(np.float32(1)) == pytest.approx(1.0)
