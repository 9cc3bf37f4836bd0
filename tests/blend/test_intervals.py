"""Sets of times: laws against membership tests."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend.intervals import (
    EMPTY,
    above_line,
    complement,
    difference,
    dilated,
    intersection,
    merged,
    neighbours,
    share,
    union,
)
from risorius.core.time import TICK

PROBES = np.arange(-8.0, 50.0, 0.25) + 0.125


@st.composite
def spans(draw: st.DrawFn) -> np.ndarray:
    """Disjoint intervals between whole numbers; some touch, some reach to infinity."""
    edges = sorted(draw(st.lists(st.integers(0, 40), max_size=8, unique=True)))
    found = np.array(edges[: len(edges) // 2 * 2], dtype=np.float64).reshape(-1, 2)
    if len(found) and draw(st.booleans()):
        found[-1, 1] = np.inf
    return found


def inside(a: np.ndarray, times: np.ndarray = PROBES) -> np.ndarray:
    return ((times[:, None] > a[:, 0]) & (times[:, None] < a[:, 1])).any(axis=1)


@given(spans(), spans())
def test_the_algebra_of_sets(a: np.ndarray, b: np.ndarray) -> None:
    assert (inside(union([a, b])) == inside(a) | inside(b)).all()
    assert (inside(intersection(a, b)) == inside(a) & inside(b)).all()
    assert (inside(difference(a, b)) == inside(a) & ~inside(b)).all()
    assert (inside(complement(a)) == ~inside(a)).all()


@given(spans(), spans())
def test_results_are_sorted_and_disjoint(a: np.ndarray, b: np.ndarray) -> None:
    for found in (union([a, b]), intersection(a, b), difference(a, b), dilated(a, 0.3, 1.2)):
        assert (np.diff(found.ravel()) > 0).all()


@given(spans())
def test_dilation_grows_every_interval(a: np.ndarray) -> None:
    expected = np.array([inside(a, t + np.linspace(-1.2, 0.3, 61)[1:-1]).any() for t in PROBES])
    assert (inside(dilated(a, 0.3, 1.2)) == expected).all()


@given(spans())
def test_neighbours_measure_to_the_nearest_intervals(a: np.ndarray) -> None:
    since, until = neighbours(a, PROBES)
    for t, before, after in zip(PROBES, since, until, strict=True):
        if inside(a, np.array([t]))[0]:
            assert before <= 0
        else:
            assert before == t - max((e for e in a[:, 1] if e < t), default=-np.inf)
            assert after == min((s for s in a[:, 0] if s > t), default=np.inf) - t


@given(spans())
def test_share_is_the_covered_part_of_a_window(a: np.ndarray) -> None:
    expected = [inside(a, t - 2.0 * (np.arange(400) + 0.5) / 400).mean() for t in PROBES]
    assert share(a, PROBES, 2.0) == pytest.approx(expected, abs=0.02)


def test_touching_intervals_join_and_instants_vanish() -> None:
    assert merged(np.array([[1.0, 2.0], [0.0, 1.0], [5.0, 5.0 + 1e-12]])).tolist() == [[0.0, 2.0]]
    assert len(merged(np.array([[0.0, 0.9 * TICK]]))) == 0
    assert len(merged(np.array([[0.0, 2.0 * TICK]]))) == 1


def test_nothing_stays_nothing() -> None:
    assert len(union([])) == len(intersection(EMPTY, EMPTY)) == len(dilated(EMPTY, 1, 1)) == 0
    assert complement(EMPTY).tolist() == [[-np.inf, np.inf]]


def test_where_a_line_is_above() -> None:
    times, values = np.array([0.0, 1.0, 2.0, 3.0]), np.array([0.5, 0.0, 0.4, 0.4])
    assert above_line(times, values, 0.2) == pytest.approx(np.array([[0.0, 0.6], [1.5, 3.0]]))
