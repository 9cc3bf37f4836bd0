"""What age does to the skin."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError
from risorius.face.skin.ageing import skin_at


@pytest.mark.parametrize("age", [-1.0, 100.5, math.nan, math.inf])
def test_ages_out_of_range_are_named(age):
    with pytest.raises(InputError, match=r"age = .* expected 0 to 100"):
        skin_at(age)


@given(st.floats(0.0, 99.9))
def test_skin_ages_continuously_and_one_way(age):
    now, later = skin_at(age), skin_at(age + 0.1)
    assert now.give >= later.give
    assert now.gain <= later.gain
    assert now.static <= later.static
    assert max(abs(a - b) for a, b in zip(now, later, strict=True)) < 0.005


def test_the_young_keep_no_crease_at_rest():
    assert skin_at(25.0).static == 0.0
    assert skin_at(26.0).static > 0.0
