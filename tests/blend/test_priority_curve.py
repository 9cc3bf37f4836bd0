"""A channel's priority over time."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.blend.priority_curve import (
    PRIORITY_RAMP,
    PriorityClaim,
    outranking,
    outranks,
    priority_curve,
    steady,
)


def at(levels: object, *times: float) -> list[float]:
    return levels.at(np.array(times)).tolist()  # type: ignore[attr-defined]


def test_without_movements_it_is_the_default() -> None:
    assert priority_curve([], 40.0).constant == 40.0


def test_equal_priorities_never_change() -> None:
    found = priority_curve([PriorityClaim(0, 1, 2, 10, 10), PriorityClaim(5, 6, 7, 10, 10)], 40.0)
    assert found.constant == 10.0


def test_the_latest_started_decides_and_is_kept() -> None:
    found = priority_curve([PriorityClaim(1, 2, 3, 80, 80), PriorityClaim(5, 6, 7, 20, 20)], 10.0)
    assert at(found, 0.0, 2.5, 4.0, 5.0, 9.0) == [80, 80, 80, 20, 20]


def test_the_release_may_have_its_own() -> None:
    found = priority_curve([PriorityClaim(1, 2, 3, 80, 10)], 10.0)
    assert at(found, 1.5, 2.0, 4.0) == [80, 10, 10]


def test_an_older_movement_still_under_way_decides_again() -> None:
    found = priority_curve([PriorityClaim(0, 9, 10, 80, 80), PriorityClaim(2, 3, 4, 20, 20)], 10.0)
    assert at(found, 1.0, 3.0, 5.0) == [80, 20, 80]


def test_weights_of_all_levels_sum_to_one_and_ramp() -> None:
    found = priority_curve([PriorityClaim(0, 9, 10, 80, 80), PriorityClaim(2, 3, 4, 20, 20)], 10.0)
    times = np.arange(0, 10, 0.003)
    weights = [found.weight(level, times) for level in found.distinct]
    assert np.sum(weights, axis=0) == pytest.approx(np.ones(len(times)))
    assert np.abs(np.diff(weights[0])).max() <= 0.003 / PRIORITY_RAMP + 1e-12
    assert found.weight(80, np.array([1.0, 3.0, 6.0])).tolist() == [1, 0, 1]


def test_outranking() -> None:
    changing = priority_curve([PriorityClaim(0, 1, 2, 80, 10)], 10.0)
    assert outranking(changing, steady(60.0)).tolist() == [[-np.inf, 1.0]]
    assert outranks(changing, steady(60.0), np.array([0.5, 5.0])).tolist() == [1, 0]
    assert outranks(steady(60.0), steady(60.0), np.array([0.5])).tolist() == [0]
