from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from risorius.errors import InputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.video.png import write_png
from risorius.ports.video.sheet import GAP, LABEL, MAX_PICTURES, WIDTH, sheet_frames, write_sheet


@pytest.mark.parametrize(
    ("count", "every", "message"),
    [
        (100, 0, "--every 0 is out of range; expected 1 or more"),
        (18_001, 5, "--every 5 makes too many pictures; expected 31 or more"),
    ],
)
def test_a_step_that_makes_no_sheet_is_refused(count: int, every: int, message: str) -> None:
    with pytest.raises(InputError, match=message):
        sheet_frames(count, every)


@given(st.integers(1, 100_000), st.integers(1, 1000))
def test_the_step_that_is_asked_for_is_kept_or_a_sufficient_one_is_named(count: int, every: int) -> None:
    try:
        frames = sheet_frames(count, every)
    except InputError as error:
        frames = sheet_frames(count, int(str(error).split()[-3]))
    else:
        assert list(frames) == list(range(0, count, every))
    assert len(frames) <= MAX_PICTURES


def test_every_fifth_frame_stands_in_order_with_ink_under_it(
    tmp_path: Path, take_of: Callable[..., WritableTake]
) -> None:
    write_png(take_of(), tmp_path / "x.png", WriteOptions(size=(400, 200), every=5))
    with Image.open(tmp_path / "x.png") as image:
        pixels = np.asarray(image)
    cell = (WIDTH // 2 + LABEL, WIDTH + GAP)
    columns = (pixels.shape[1] - GAP) // cell[1]
    for place in range(7):
        row, column = divmod(place, columns)
        picture = pixels[GAP + row * cell[0] :, GAP + column * cell[1] :][: WIDTH // 2, :WIDTH]
        label = pixels[GAP + row * cell[0] + WIDTH // 2 :, GAP + column * cell[1] :][:LABEL, :WIDTH]
        assert (picture == 10 + 5 * place).all()
        assert (label < 128).any()


@pytest.mark.parametrize("size", [(1, 1), (2000, 3), (20, 3000)])
def test_any_size_makes_a_sheet(
    tmp_path: Path, take_of: Callable[..., WritableTake], size: tuple[int, int]
) -> None:
    write_sheet(take_of(), tmp_path / "x.png", WriteOptions(size=size), 7)
    with Image.open(tmp_path / "x.png") as image:
        assert min(image.size) > 0
