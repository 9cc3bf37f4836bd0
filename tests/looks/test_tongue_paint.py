from __future__ import annotations

import numpy as np

from risorius.face.head.head import load_head
from risorius.looks.tongue_paint import tongue_colours


def test_its_back_is_paler_than_its_edges_and_furrowed():
    tongue = load_head().tongue
    points = np.asarray(tongue.subdivision.matrix @ tongue.rest)
    colours = tongue_colours(points)
    assert colours.min() > 0.0
    assert colours.max() < 1.0
    back = (points[:, 2] > -40.0) & (points[:, 2] < -10.0)
    aside = np.abs(points[:, 0])
    furrow, beside = back & (aside < 0.5), back & (aside > 5.0) & (aside < 8.0)
    edge = aside > 0.95 * aside.max()
    assert colours[furrow].mean() < 0.8 * colours[beside].mean()
    assert colours[edge].mean() < colours[beside].mean()
    redness = colours[:, 0] / colours[:, 1]
    assert redness[edge].mean() > 1.2 * redness[beside].mean()
