import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.looks.noise import SIZE, noise_at, noise_tile
from risorius.render.grain import grain
from tests.profiles import examples

PLACE = st.tuples(*[st.floats(-300, 300)] * 3)


@examples(50)
@given(PLACE)
def test_the_kernel_agrees_with_numpy_at_all_places(place):
    point = np.array(place, np.float32)
    height = grain(noise_tile(), tuple(point), np.float32(1.0))[0]
    expected = noise_at((point.astype(float) + (0.63 * SIZE))[None], 6.5)
    assert height == pytest.approx(expected[0], abs=0.02)


@examples(50)
@given(PLACE)
def test_slopes_are_those_of_the_heights(place):
    cells, step = 0.5, 0.02
    point = np.floor(np.array(place)) + 0.9  # within a cell, where the height is smooth
    slopes = grain(noise_tile(), tuple(np.float32(point)), np.float32(cells))[1:]
    for axis in range(3):
        ahead = point.copy()
        ahead[axis] += step
        here = grain(noise_tile(), tuple(np.float32(point)), np.float32(cells))[0]
        there = grain(noise_tile(), tuple(np.float32(ahead)), np.float32(cells))[0]
        assert (there - here) / step == pytest.approx(slopes[axis], abs=0.08)
