import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.face.numerics import robust_fit
from risorius.face.numerics.nonnegative import least_squares
from risorius.face.numerics.robust_fit import FAR, RobustFit
from tests.profiles import examples

SHAPES, VERTICES = 6, 40


def problem(seed: int, size: float = 3.0):
    """A surface that the shapes nearly make, but for three vertices that are `size` mm off."""
    draw = np.random.default_rng(seed)
    basis = draw.normal(size=(SHAPES, 3 * VERTICES))
    wanted = draw.random(SHAPES) @ basis
    wanted.reshape(-1, 3)[:3] += size * draw.normal(size=3)
    normal, right = basis @ basis.T + 1e-3 * np.eye(SHAPES), basis @ wanted
    return surface(basis, wanted, normal, right)


def surface(basis, wanted, normal, right):
    start = least_squares(normal, right, np.zeros(SHAPES))
    left = (wanted - start @ basis).reshape(-1, 3)
    moves = np.ascontiguousarray(basis.T.reshape(VERTICES, 3, SHAPES))
    return RobustFit(moves, left, normal, right, start), start


def test_what_is_near_stays_as_the_least_squares_have_it() -> None:
    held, start = problem(0, size=0.2)
    assert np.array_equal(held.minimum(start), start)


@examples(25)
@given(st.integers(0, 10_000))
def test_it_is_the_least(seed: int) -> None:
    """No weights nearby cost less, whichever way one goes within the limits."""
    held, start = problem(seed)
    found = held.minimum(start)
    cost = held.at(found).cost
    assert cost <= held.at(start).cost
    draw = np.random.default_rng(seed + 1)
    for step in draw.normal(scale=1e-3, size=(60, SHAPES)):
        near = held.at(np.maximum(found + step, 0.0)).cost
        assert near >= cost - 1e-4 * abs(cost)


def test_the_way_to_the_least_does_not_count() -> None:
    held, start = problem(3)
    others = np.random.default_rng(0).random((5, SHAPES))
    found = held.minimum(start)
    assert held.at(found).distance.max() > FAR  # the worst cannot be made good
    for other in others:
        assert held.minimum(other) == pytest.approx(found, abs=1e-3)


def test_a_shape_that_moves_nothing_stays() -> None:
    draw = np.random.default_rng(4)
    basis = draw.normal(size=(SHAPES, 3 * VERTICES))
    basis[1] = 0.0
    wanted = draw.random(SHAPES) @ basis + 2.0 * draw.normal(size=3 * VERTICES)
    held, start = surface(basis, wanted, basis @ basis.T + 1e-3 * np.eye(SHAPES), basis @ wanted)
    found = held.minimum(start)
    assert found[1] == pytest.approx(start[1], abs=1e-9)
    assert np.abs(found - start).max() > 0.01


def test_the_worst_comes_nearer() -> None:
    held, start = problem(3)
    before, after = (held.at(weights).distance.max() for weights in (start, held.minimum(start)))
    assert after < before - 0.3


def test_no_weight_goes_far_from_the_least_squares(monkeypatch: pytest.MonkeyPatch) -> None:
    held, start = problem(3)
    monkeypatch.setattr(robust_fit, "LEEWAY", 0.5 * np.abs(held.minimum(start) - start).max())
    found = start + robust_fit.within_leeway(held.minimum(start) - start)
    assert np.abs(found - start).max() == pytest.approx(robust_fit.LEEWAY)
    costs = [held.at(weights).cost for weights in (held.minimum(start), found, start)]
    assert costs == sorted(costs)
