import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import nnls

from risorius.face.numerics import nonnegative
from risorius.face.numerics.nonnegative import least_squares
from tests.profiles import examples


def problem(seed: int, unknowns: int = 12):
    """Nearly parallel columns, some of which would be negative without a limit."""
    draw = np.random.default_rng(seed)
    matrix = draw.normal(size=(30, unknowns)) + 3.0 * draw.normal(size=(30, 1))
    wanted = matrix @ draw.normal(size=unknowns) + draw.normal(size=30)
    return matrix, wanted, matrix.T @ matrix, matrix.T @ wanted


@examples(50)
@given(st.integers(0, 10_000))
def test_it_is_the_non_negative_least_squares(seed: int) -> None:
    matrix, wanted, normal, right = problem(seed)
    found = least_squares(normal, right, np.zeros(12))
    assert found == pytest.approx(nnls(matrix, wanted)[0], abs=1e-9)
    assert (found == 0.0).any()


@examples(25)
@given(st.integers(0, 10_000))
def test_it_does_not_depend_on_where_the_search_begins(seed: int) -> None:
    _, _, normal, right = problem(seed)
    draw = np.random.default_rng(seed + 1)
    found = least_squares(normal, right, np.zeros(12))
    for _ in range(5):
        other = least_squares(normal, right, draw.normal(size=12))
        assert other.tobytes() == found.tobytes()


def test_changing_one_unknown_at_a_time_ends_at_the_same_place(monkeypatch: pytest.MonkeyPatch) -> None:
    _, _, normal, right = problem(7)
    monkeypatch.setattr(nonnegative, "search", nonnegative.search.declared.function)  # type: ignore[attr-defined]
    found = least_squares(normal, right, np.zeros(12))
    monkeypatch.setattr(nonnegative, "PATIENCE", -1)
    alone = least_squares(normal, right, np.zeros(12))
    assert alone == pytest.approx(found, abs=1e-12)


def test_nothing_is_wanted() -> None:
    _, _, normal, _ = problem(1)
    assert not least_squares(normal, np.zeros(12), np.ones(12)).any()
