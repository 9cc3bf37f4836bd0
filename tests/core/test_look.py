import pytest

from risorius.core.look import COMPLEXIONS, parse_camera, parse_colour, parse_complexion, parse_overlay
from risorius.errors import InputError
from risorius.settings import Look


@pytest.mark.parametrize(
    ("choice", "message"),
    [
        ({"style": "clya"}, "unknown style 'clya'; did you mean 'clay'"),
        ({"camera": "closeup"}, "unknown camera 'closeup'; did you mean 'close-up'"),
        ({"light": "sun"}, "unknown light 'sun'; expected one of studio"),
        ({"quality": "hihg"}, "did you mean 'high'"),
        ({"hair": "bold"}, "unknown hair style 'bold'; did you mean 'bald'"),
        ({"overlay": ("captions",)}, "unknown overlay 'captions'; did you mean 'caption'"),
        ({"lens": 5.0}, "lens = 5 is out of range; expected 20 to 400"),
        ({"complexion": 1.5}, "complexion = 1.5 is out of range; expected 0 to 1"),
    ],
)
def test_a_choice_that_does_not_exist_is_an_error(choice, message):
    with pytest.raises(InputError, match=message):
        Look(**choice)


@pytest.mark.parametrize("text", ["portrait:", "portrait:wide", "portrait:85:2"])
def test_a_lens_that_is_no_number_is_an_error(text):
    with pytest.raises(InputError, match="has no focal length in mm"):
        parse_camera(text)


def test_a_complexion_that_is_neither_name_nor_number_is_an_error():
    with pytest.raises(InputError, match="unknown complexion 'drak'; did you mean 'dark'"):
        parse_complexion("drak")


def test_an_overlay_that_does_not_exist_is_an_error():
    with pytest.raises(InputError, match="unknown overlay 'lane'; did you mean 'lanes'"):
        parse_overlay("caption,lane")


def test_texts_of_the_command_line():
    assert parse_camera("profile") == ("profile", 85.0)
    assert parse_camera("close-up:135") == parse_camera("close-up:135mm") == ("close-up", 135.0)
    assert [parse_complexion(name) for name in COMPLEXIONS] == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert parse_complexion("0.3") == 0.3
    assert parse_overlay("bars, caption") == ("caption", "bars")


def test_only_a_transparent_background_is_transparent():
    assert Look(background="transparent").transparent
    assert not Look(background="white").transparent
    assert not Look().transparent


def test_what_is_no_colour_is_an_error():
    with pytest.raises(
        InputError,
        match=r"background 'blurple' is neither a colour .*; did you mean 'purple'",
    ):
        parse_colour("blurple")


def test_colours_are_read_as_css_writes_them():
    assert parse_colour("#203040") == parse_colour("rgb(32, 48, 64)") == (32, 48, 64)
    assert parse_colour("white") == (255, 255, 255)
