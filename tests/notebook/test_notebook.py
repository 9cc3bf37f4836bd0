"""A take in a notebook: its page, its figure, its table; and what is told where a package is missing."""

from __future__ import annotations

import base64
import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import nullcontext
from dataclasses import replace
from io import BytesIO
from operator import attrgetter
from types import SimpleNamespace
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import risorius
from risorius.core.arkit import SHAPES
from risorius.core.arrays import ByteArray
from risorius.core.parameters import NAMES
from risorius.notebook.page import html
from risorius.notebook.shown_take import liveliest


def test_the_page_has_a_picture_the_sound_and_the_curves(clip: risorius.Take) -> None:
    page = html(clip, b"\x89PNG")
    tree = ET.fromstring(re.sub(r"<(img)([^>]*)>", r"<\1\2/>", page).replace(" controls ", " "))
    (picture,) = tree.iter("img")
    (sound,) = tree.iter("audio")
    assert base64.b64decode(picture.attrib["src"].partition(",")[2])[1:4] == b"PNG"
    assert clip.audio is not None
    assert base64.b64decode(sound.attrib["src"].partition(",")[2]) == clip.audio.path.read_bytes()
    assert [text.text for text in tree.iter("text")] == ["Oh", "my", "mother"]
    lines = {next(iter(line)).text: line.attrib["points"].split() for line in tree.iter("polyline")}
    assert lines.keys() == liveliest(clip.performance).keys()
    assert {len(points) for points in lines.values()} == {len(clip.times)}


def test_a_page_of_nothing_said_has_no_sound(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(risorius.Take, "_repr_png_", lambda take: b"\x89PNG")
    page = risorius.pose({"AU12": 1.0})._repr_html_()
    assert "<audio" not in page
    assert "<img" in page


def test_the_curves_that_move_most_are_shown_without_their_sides(clip: risorius.Take) -> None:
    shown = liveliest(clip.performance)
    assert 3 < len(shown) <= 8
    assert "zygomatic_major" in shown
    sides = [clip.curves[f"zygomatic_major.{side}"] for side in ("left", "right")]
    np.testing.assert_allclose(shown["zygomatic_major"], np.mean(sides, axis=0))


@pytest.mark.parametrize(
    ("call", "package"),
    [("to_pandas", "pandas"), ("arkit.to_pandas", "pandas"), ("plot", "matplotlib.figure")],
)
def test_a_package_that_is_missing_is_named(
    call: str, package: str, clip: risorius.Take, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(risorius.RisoriusError, match=r"needs (\w+); run pip install \1$"):
        attrgetter(call)(clip)()


def test_the_table_is_given_times_values_and_names(
    clip: risorius.Take, monkeypatch: pytest.MonkeyPatch
) -> None:
    pandas = SimpleNamespace(
        Index=lambda values, name: (values, name), DataFrame=lambda *it, **named: (it, named)
    )
    monkeypatch.setitem(sys.modules, "pandas", pandas)
    (values,), named = clip.to_pandas()
    assert values is not clip.performance.values
    np.testing.assert_array_equal(values, clip.performance.values)
    assert named["columns"] == list(NAMES)
    np.testing.assert_array_equal(named["index"][0], clip.times)
    assert named["index"][1] == "time_s"


def test_a_data_frame_of_pandas_is_that_table(clip: risorius.Take) -> None:
    pytest.importorskip("pandas")
    frame = clip.to_pandas()
    assert frame.shape == clip.performance.values.shape
    np.testing.assert_array_equal(frame["masseter"], clip.curves["masseter"])
    assert frame.index.name == "time_s"


def test_weights_have_names_and_are_a_table(clip: risorius.Take) -> None:
    weights = clip.arkit.weights
    assert clip.arkit.names == SHAPES
    np.testing.assert_array_equal(clip.arkit["jawOpen"], weights[:, SHAPES.index("jawOpen")])
    with pytest.raises(risorius.RisoriusError, match="did you mean 'jawOpen'"):
        clip.arkit["jawOpne"]
    pytest.importorskip("pandas")
    frame = clip.arkit.to_pandas()
    assert list(frame.columns) == list(SHAPES)
    assert frame.index.name == "time_s"
    np.testing.assert_array_equal(frame.index, clip.times)
    np.testing.assert_array_equal(frame.to_numpy(), weights)
    frame.loc[:, "jawOpen"] = 2.0
    assert clip.arkit["jawOpen"].max() <= 1.0
    alone = replace(clip.arkit, times=None).to_pandas()
    assert (alone.index.name, list(alone.index)) == ("frame", list(range(len(weights))))


def test_the_figure_has_sound_curves_head_and_channels(clip: risorius.Take) -> None:
    pytest.importorskip("matplotlib")
    figure = clip.plot()
    sound, curves, head, lanes = figure.axes
    assert [text.get_text() for text in sound.texts] == ["Oh", "my", "mother"]
    assert {line.get_label() for line in curves.lines} == set(liveliest(clip.performance))
    assert len(head.lines) == 5
    assert "lips" in [label.get_text() for label in lanes.get_yticklabels()]
    figure.savefig(BytesIO(), format="svg")
    named = clip.plot("zygomatic_major", "lip_seal").axes[1]
    assert [line.get_label() for line in named.lines] == [
        "zygomatic_major.left", "zygomatic_major.right", "lip_seal",
    ]  # fmt: skip
    with pytest.raises(risorius.RisoriusError, match="did you mean 'masseter'"):
        clip.plot("masetter")
    risorius.pose({"AU12": 1.0}).plot()


class OneArray:
    """A renderer that draws every picture into the same array."""

    def __init__(self) -> None:
        self.array = np.zeros((32, 48, 3), np.uint8)

    def draw(self, inputs: Iterable[object]) -> Iterator[ByteArray]:
        for number, _ in enumerate(inputs):
            self.array[:] = number
            yield self.array


def test_pictures_are_arrays_of_their_own(clip: risorius.Take, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("risorius.render.open_renderer", lambda setup: nullcontext(OneArray()))
    pictures = list(clip.pictures((48, 32), [3, 5, 7]))
    assert [picture.shape for picture in pictures] == [(32, 48, 3)] * 3
    assert [int(picture.max()) for picture in pictures] == [0, 1, 2]
