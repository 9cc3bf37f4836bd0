import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import nnls

from risorius.face import far_vertices
from risorius.face.far_vertices import FAR, FarVertices
from tests.profiles import examples

SHAPES, VERTICES = 6, 40


def problem(seed: int, size: float = 3.0):
    """A surface that the shapes nearly make, but for three vertices that are `size` mm off."""
    draw = np.random.default_rng(seed)
    basis = draw.normal(size=(SHAPES, 3 * VERTICES))
    wanted = draw.random(SHAPES) @ basis
    wanted.reshape(-1, 3)[:3] += size * draw.normal(size=3)
    normal, right = basis @ basis.T + 1e-3 * np.eye(SHAPES), basis @ wanted
    moves = basis.T.reshape(VERTICES, 3, SHAPES)
    return FarVertices(moves, wanted.reshape(-1, 3), normal, right), least(normal, right)


def least(normal, right):
    factor = np.linalg.cholesky(normal)
    return nnls(factor.T, np.linalg.solve(factor, right))[0]


def test_what_is_near_stays_as_the_least_squares_have_it() -> None:
    held, start = problem(0, size=0.2)
    assert np.array_equal(held.minimum(start, least), start)


@examples(25)
@given(st.integers(0, 10_000))
def test_it_is_the_least(seed: int) -> None:
    """No weights nearby cost less, whichever way one goes within the limits."""
    held, start = problem(seed)
    found = held.minimum(start, least)
    cost, _ = held.cost(found)
    assert cost <= held.cost(start)[0]
    draw = np.random.default_rng(seed + 1)
    for step in draw.normal(scale=1e-3, size=(60, SHAPES)):
        near, _ = held.cost(np.maximum(found + step, 0.0))
        assert near >= cost - 1e-4 * abs(cost)


def test_the_way_to_the_least_does_not_count() -> None:
    held, start = problem(3)
    others = np.random.default_rng(0).random((5, SHAPES))
    found = held.minimum(start, least)
    assert held.cost(found)[1].max() > FAR  # the worst cannot be made good
    for other in others:
        assert held.minimum(other, least) == pytest.approx(found, abs=1e-3)


def test_the_worst_comes_nearer() -> None:
    held, start = problem(3)
    before, after = (held.cost(weights)[1].max() for weights in (start, held.minimum(start, least)))
    assert after < before - 0.3


def test_no_weight_goes_far_from_the_least_squares(monkeypatch: pytest.MonkeyPatch) -> None:
    held, start = problem(3)
    monkeypatch.setattr(far_vertices, "LEEWAY", 0.5 * np.abs(held.minimum(start, least) - start).max())
    found = start + far_vertices.within_leeway(held.minimum(start, least) - start)
    assert np.abs(found - start).max() == pytest.approx(far_vertices.LEEWAY)
    costs = [held.cost(weights)[0] for weights in (held.minimum(start, least), found, start)]
    assert costs == sorted(costs)
