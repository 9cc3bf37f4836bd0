import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.looks.srgb import linear, srgb_decode, srgb_encode


@given(st.floats(0, 1))
def test_srgb_there_and_back(value):
    assert srgb_decode(srgb_encode(np.array(value))) == pytest.approx(value, abs=1e-6)


def test_known_values_of_srgb():
    assert srgb_encode(np.array([0.0, 0.2140411, 1.0])) == pytest.approx([0.0, 0.5, 1.0], abs=1e-5)


def test_colours_are_decoded_from_srgb():
    assert linear((0, 188, 255)) == pytest.approx([0, 0.5029, 1], abs=1e-3)
