import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.numerics.nonnegative import least_squares
from risorius.face.numerics.soft_limits import within_limits
from tests.profiles import examples

UNKNOWNS, LIMITS, PROBLEMS = 6, 9, 3


def problems(seed: int) -> tuple[np.ndarray, ...]:
    """Return normal equations, right sides, and limits with their rows and stiffness."""
    draw = np.random.default_rng(seed)
    root = draw.normal(size=(UNKNOWNS, UNKNOWNS + 2))
    normal = root @ root.T + 0.1 * np.eye(UNKNOWNS)
    right = draw.normal(size=(PROBLEMS, UNKNOWNS)) * 3.0
    rows, limit = draw.normal(size=(PROBLEMS, LIMITS, UNKNOWNS)), draw.normal(size=(PROBLEMS, LIMITS))
    return normal, right, rows, limit, 10.0 ** draw.uniform(0.0, 5.0, (PROBLEMS, LIMITS))


@examples(40)
@given(st.integers(0, 10_000))
def test_no_direction_lowers_the_cost(seed: int) -> None:
    """At the minimum the slope is 0 along unknowns above 0, and not negative along those at 0."""
    normal, right, rows, limit, stiff = problems(seed)
    found = within_limits(normal, right, rows, limit, stiff, np.zeros((PROBLEMS, UNKNOWNS)))
    for w, r, a, h, s in zip(found, right, rows, limit, stiff, strict=True):
        slope = normal @ w - r + a.T @ (s * np.maximum(a @ w - h, 0.0))
        scale = 1.0 + (np.abs(a).max() ** 2 * s).max()
        assert w.min() >= 0.0
        assert np.abs(slope[w > 0.0]).max(initial=0.0) < 1e-8 * scale
        assert slope[w == 0.0].min(initial=0.0) > -1e-8 * scale


@examples(20)
@given(st.integers(0, 10_000))
def test_the_beginning_does_not_matter(seed: int) -> None:
    normal, right, rows, limit, stiff = problems(seed)
    begin = np.random.default_rng(seed + 1).uniform(0.0, 2.0, (PROBLEMS, UNKNOWNS))
    found = [within_limits(normal, right, rows, limit, stiff, b) for b in (begin, np.zeros_like(begin))]
    assert found[0] == pytest.approx(found[1], abs=1e-6)


def test_limits_that_nothing_reaches_do_not_matter() -> None:
    normal, right, rows, _, stiff = problems(1)
    found = within_limits(normal, right, rows, np.full(stiff.shape, 100.0), stiff, np.zeros_like(right))
    alone = [least_squares(normal, r, np.zeros(UNKNOWNS)) for r in right]
    assert found == pytest.approx(np.array(alone), abs=1e-12)


def test_stiff_limits_hold_and_contradictory_ones_meet_in_the_middle() -> None:
    normal, right = np.eye(1), np.array([[5.0], [0.0]])
    rows, limit = np.array([[[1.0], [-1.0]]] * 2), np.array([[2.0, 0.0], [1.0, -3.0]])
    found = within_limits(normal, right, rows, limit, np.full((2, 2), 1e6), np.zeros((2, 1)))
    assert found[:, 0] == pytest.approx([2.0, 2.0], abs=1e-4)
