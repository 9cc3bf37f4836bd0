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
    start, free = least(normal, right), np.ones(SHAPES, dtype=bool)
    return FarVertices(moves, wanted.reshape(-1, 3), normal, right, start, free), start


def least(normal, right):
    factor = np.linalg.cholesky(normal)
    return nnls(factor.T, np.linalg.solve(factor, right))[0]


def test_what_is_near_stays_as_the_least_squares_have_it() -> None:
    held, start = problem(0, size=0.2)
    assert np.array_equal(held.minimum(least, start), start)


@examples(25)
@given(st.integers(0, 10_000))
def test_it_is_the_least(seed: int) -> None:
    """No weights nearby cost less, whichever way one goes within the limits."""
    held, start = problem(seed)
    found = held.minimum(least, start)
    cost = held.at(found).cost
    assert cost <= held.at(start).cost
    draw = np.random.default_rng(seed + 1)
    for step in draw.normal(scale=1e-3, size=(60, SHAPES)):
        near = held.at(np.maximum(found + step, 0.0)).cost
        assert near >= cost - 1e-4 * abs(cost)


def test_the_way_to_the_least_does_not_count() -> None:
    held, start = problem(3)
    others = np.random.default_rng(0).random((5, SHAPES))
    found = held.minimum(least, start)
    assert held.at(found).distance.max() > FAR  # the worst cannot be made good
    for other in others:
        assert held.minimum(least, other) == pytest.approx(found, abs=1e-3)


def test_shapes_that_move_nothing_far_or_are_not_free_stay() -> None:
    draw = np.random.default_rng(4)
    moves = draw.normal(size=(VERTICES, 3, SHAPES))
    moves[:, :, 1] = 0.0
    basis = moves.reshape(-1, SHAPES).T
    wanted = draw.random(SHAPES) @ basis + 2.0 * draw.normal(size=3 * VERTICES)
    normal, right = basis @ basis.T + 1e-3 * np.eye(SHAPES), basis @ wanted
    free, start = np.arange(SHAPES) != 2, least(normal, right)

    def held_least(normal, right):
        found = start.copy()
        rest = right[free] - normal[np.ix_(free, ~free)] @ start[~free]
        found[free] = least(normal[np.ix_(free, free)], rest)
        return found

    found = FarVertices(moves, wanted.reshape(-1, 3), normal, right, start, free).minimum(held_least, start)
    assert found[2] == start[2]
    assert found[1] == pytest.approx(start[1], abs=1e-9)
    assert np.abs(found - start).max() > 0.01


def test_the_worst_comes_nearer() -> None:
    held, start = problem(3)
    before, after = (held.at(weights).distance.max() for weights in (start, held.minimum(least, start)))
    assert after < before - 0.3


def test_no_weight_goes_far_from_the_least_squares(monkeypatch: pytest.MonkeyPatch) -> None:
    held, start = problem(3)
    monkeypatch.setattr(far_vertices, "LEEWAY", 0.5 * np.abs(held.minimum(least, start) - start).max())
    found = start + far_vertices.within_leeway(held.minimum(least, start) - start)
    assert np.abs(found - start).max() == pytest.approx(far_vertices.LEEWAY)
    costs = [held.at(weights).cost for weights in (held.minimum(least, start), found, start)]
    assert costs == sorted(costs)
