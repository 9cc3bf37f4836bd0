from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import nnls

from risorius.face.numerics.complementarity import Gaps, Workspace, solve_gaps

INF = np.inf


def solve(gaps, compliance, sweeps=2000):
    force = np.zeros(len(compliance))
    solve_gaps(gaps, compliance, sweeps, Workspace.allocate(len(gaps.gap), len(compliance)), force)
    opened = np.array([w @ (compliance @ force)[p] for p, w in zip(gaps.points, gaps.weight, strict=True)])
    return gaps.gap + opened, force


def pairs(gap, low, high):
    """Gaps between point 2k + 1 and point 2k."""
    count = len(gap)
    points = np.zeros((count, 4), np.uint32)
    points[:, 0], points[:, 1] = 2 * np.arange(count), 2 * np.arange(count) + 1
    weight = np.tile([-1.0, 1.0, 0.0, 0.0], (count, 1))
    return Gaps(points, weight, np.array(gap), np.full(count, low), np.full(count, high))


@pytest.fixture
def compliance():
    """Ten points along a stiff strip."""
    at = np.arange(10)
    return np.exp(-np.abs(at[:, None] - at) / 6.0)


def test_gaps_within_their_bounds_are_left_alone(compliance):
    gap, force = solve(pairs([0.1, 0.2, 0.3, 0.4, 0.5], 0.0, INF), compliance)
    assert not force.any()
    assert gap.tolist() == [0.1, 0.2, 0.3, 0.4, 0.5]


def test_overlaps_are_pushed_apart_and_nothing_is_pulled_together(compliance):
    gap, _ = solve(pairs([-0.5, 0.2, -0.1, 0.4, 1.5], 0.0, INF), compliance)
    assert gap.min() > -2e-3
    assert gap[4] == pytest.approx(1.5, abs=0.2)


def test_wide_gaps_are_closed_to_their_upper_bound(compliance):
    gap, _ = solve(pairs([0.5, 0.2, 0.1, 0.4, 1.5], 0.0, 0.05), compliance)
    assert gap.max() < 0.05 + 2e-3
    assert gap.min() > -2e-3


def test_pushes_agree_with_non_negative_least_squares(compliance):
    gaps = pairs([-0.5, 0.3, -0.2, 0.1, -0.4], 0.0, INF)
    rows = np.zeros((5, 10))
    for row, p, w in zip(rows, gaps.points, gaps.weight, strict=True):
        np.add.at(row, p, w)
    matrix = rows @ compliance @ rows.T
    root = np.linalg.cholesky(matrix).T
    push, _ = nnls(root, np.linalg.solve(root.T, -gaps.gap))
    _, force = solve(gaps, compliance)
    np.testing.assert_allclose(force, rows.T @ push, atol=5e-3)
