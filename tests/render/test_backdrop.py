import numpy as np
import pytest
from PIL import Image

from risorius.errors import InputError
from risorius.looks.srgb import srgb_encode
from risorius.render.backdrop import backdrop

GREYS = ((118, 126, 132), (48, 54, 62))


def shown(asked, width=40, height=20):
    return np.round(srgb_encode(backdrop(width, height, asked, *GREYS)) * 255)


def test_what_is_neither_colour_nor_file_is_an_error():
    with pytest.raises(
        InputError,
        match=r"background 'blurple' is neither a colour .*; did you mean 'purple'",
    ):
        shown("blurple")


def test_a_file_that_is_no_picture_is_an_error_with_its_name(tmp_path):
    path = tmp_path / "x.png"
    path.write_text("no picture")
    with pytest.raises(InputError, match=r"x\.png: not a picture"):
        shown(str(path))


def test_a_colour_fills_the_picture():
    assert (shown("#203040") == (32, 48, 64)).all()
    assert (shown("white") == 255).all()


def test_a_picture_is_cut_about_its_middle(tmp_path):
    image = np.zeros((90, 60, 3), np.uint8)
    image[30:60] = (200, 100, 50)
    Image.fromarray(image).save(tmp_path / "x.png")
    picture = shown(str(tmp_path / "x.png"))
    assert np.abs(picture[3:-3] - (200, 100, 50)).max() <= 1


def test_the_light_brings_its_own_gradient():
    picture = shown(None)
    assert picture[9, 20].mean() > picture[0, 0].mean() + 10
