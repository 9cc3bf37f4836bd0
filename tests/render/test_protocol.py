"""The laws of every renderer, and that one more is one file."""

from __future__ import annotations

import sys

import numpy as np
import pytest

from risorius import pose
from risorius.core.progress import quiet
from risorius.errors import InputError, ParameterError
from risorius.render import renderers
from risorius.render.protocol import RENDERERS, PictureInput, RendererSetup, open_renderer
from risorius.settings import Look, Settings

SIZE = (48, 64)


@pytest.fixture
def opened(head, face):
    """A function from a renderer's name and a look to the renderer."""

    def renderer(name="software", size=SIZE, **look):
        return open_renderer(RendererSetup(head, size, Look(**look), face, quiet), name)

    return renderer


PLAIN = """
import numpy as np

from risorius.render.protocol import RENDERERS


class Plain:
    def __init__(self, size):
        self.shape = (size[1], size[0], 3)

    def draw(self, inputs):
        for frame, _ in inputs:
            yield np.full(self.shape, round(np.degrees(frame.jaw_angle)), np.uint8)

    def close(self):
        pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


@RENDERERS.register("plain")
def open_plain(setup):
    return Plain(setup.size)
"""


@pytest.fixture
def plain_file(tmp_path, monkeypatch):
    """One more file among the renderers, for as long as the test runs."""
    (tmp_path / "plain.py").write_text(PLAIN)
    monkeypatch.setattr(renderers, "__path__", [*renderers.__path__, str(tmp_path)])
    yield
    if "plain" in RENDERERS:
        RENDERERS.forget("plain")
    sys.modules.pop(f"{renderers.__name__}.plain")


def test_an_unknown_renderer_is_an_error_with_the_nearest_one(opened):
    with pytest.raises(ParameterError, match="unknown renderer 'sofware'; did you mean 'software'"):
        opened("sofware")


def test_a_size_that_cannot_be_drawn_is_an_error(opened):
    with pytest.raises(InputError, match="picture size"):
        opened(size=(8, 8))


@pytest.mark.parametrize(("background", "channels"), [(None, 3), ("transparent", 4)])
def test_pictures_are_bytes_of_the_shape_that_is_told(opened, face, background, channels):
    with opened(background=background) as renderer:
        assert renderer.shape == (64, 48, channels)
        (picture,) = renderer.draw([PictureInput(face())])
    assert picture.shape == renderer.shape
    assert picture.dtype == np.uint8


def test_a_picture_depends_on_its_input_alone(opened, face):
    smile, turn = PictureInput(face(AU12=0.8)), PictureInput(face(head_yaw=20.0))
    with opened() as renderer:
        alone = [next(renderer.draw([one])).copy() for one in (smile, turn)]
        again = [picture.copy() for picture in renderer.draw([turn, smile, turn])]
    assert [a.tobytes() for a in again] == [alone[k].tobytes() for k in (1, 0, 1)]


def test_one_more_renderer_is_one_file(plain_file, opened, face):
    (picture,) = opened("plain").draw([PictureInput(face(masseter=1.0))])
    assert picture.shape == (64, 48, 3)
    assert picture.min() > 5


def test_a_take_needs_the_protocol_alone(plain_file, opened):
    opened("plain")
    own = RENDERERS.forget("software")
    RENDERERS.register("software")(RENDERERS.get("plain"))
    try:
        take = pose({"masseter": 1.0}, settings=Settings(size=SIZE))
        assert [picture.min() > 5 for picture in take.pictures()] == [True] * len(take.times)
    finally:
        RENDERERS.forget("software")
        RENDERERS.register("software")(own)
