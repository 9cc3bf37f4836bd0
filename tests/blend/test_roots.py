"""Roots: exact ends, smooth functions, jumps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend.roots import find_roots


@given(st.lists(st.floats(0.01, 0.99), min_size=1, max_size=8))
def test_finds_each_root_of_its_own_function(roots: list[float]) -> None:
    wanted = np.array(roots)
    found = find_roots(lambda x: np.exp2(x) - np.exp2(wanted), np.zeros(len(roots)), np.ones(len(roots)))
    assert found == pytest.approx(wanted, abs=1e-12)


def test_a_jump_counts_as_a_root() -> None:
    found = find_roots(lambda x: np.where(x < 0.3, 1.0, -5.0), np.zeros(1), np.ones(1))
    assert found == pytest.approx([0.3], abs=1e-12)


def test_a_zero_at_an_end_is_the_root() -> None:
    assert find_roots(lambda x: x, np.zeros(1), np.ones(1)).tolist() == [0.0]
    assert find_roots(lambda x: 1.0 - x, np.zeros(1), np.ones(1)).tolist() == [1.0]
