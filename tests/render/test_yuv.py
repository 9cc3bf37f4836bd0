import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from risorius.render.yuv import planes
from tests.profiles import examples


def in_film(rgb):
    rgb = np.asarray(rgb, np.uint8)
    height, width, _ = rgb.shape
    out = np.zeros(height * width * 3 // 2, np.uint8)
    planes(rgb, out)
    return out[: height * width].reshape(height, width), *out[height * width :].reshape(
        2, height // 2, width // 2
    )


@pytest.mark.parametrize(
    ("colour", "expected"),
    [
        ((0, 0, 0), (16, 128, 128)),
        ((255, 255, 255), (235, 128, 128)),
        ((128, 128, 128), (126, 128, 128)),
        ((255, 0, 0), (63, 102, 240)),
        ((0, 255, 0), (173, 42, 26)),
        ((0, 0, 255), (32, 240, 118)),
    ],
    ids=["black", "white", "grey", "red", "green", "blue"],
)
def test_colours_are_those_of_the_standard(colour, expected):
    for plane, value in zip(in_film(np.tile(colour, (4, 6, 1))), expected, strict=True):
        assert (plane == value).all()


@examples(40)
@given(arrays(np.uint8, (4, 6, 3), elements=st.integers(0, 255)))
def test_planes_are_the_rounded_formula(rgb):
    r, g, b = np.moveaxis(rgb.astype(float), -1, 0)
    bright = 0.2126 * r + 0.7152 * g + 0.0722 * b
    means = [(p[::2, ::2] + p[1::2, ::2] + p[::2, 1::2] + p[1::2, 1::2]) / 4 for p in (r, b, bright)]
    wanted = (
        16 + bright * 219 / 255,
        128 + (means[1] - means[2]) / 1.8556 * 224 / 255,
        128 + (means[0] - means[2]) / 1.5748 * 224 / 255,
    )
    for plane, exact in zip(in_film(rgb), wanted, strict=True):
        assert np.abs(plane - exact).max() <= 0.53
