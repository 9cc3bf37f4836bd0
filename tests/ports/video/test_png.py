from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from risorius.errors import InputError
from risorius.ports.export_source import WritableTake, WriteOptions
from risorius.ports.video.png import frame_at, write_png


@pytest.mark.parametrize("seconds", [-0.1, 1.1, float("nan"), float("inf")])
def test_a_time_outside_is_refused_with_the_range(
    take_of: Callable[..., WritableTake], seconds: float
) -> None:
    with pytest.raises(InputError, match="outside the performance; expected 0 to 1 seconds"):
        frame_at(take_of().performance, seconds)


@pytest.mark.parametrize(("seconds", "index"), [(None, 15), (0.0, 0), (1.0, 30), (0.34, 10)])
def test_the_nearest_frame_is_drawn_exactly(
    tmp_path: Path, take_of: Callable[..., WritableTake], seconds: float | None, index: int
) -> None:
    write_png(take_of(), tmp_path / "x.png", WriteOptions(size=(33, 21), at=seconds))
    with Image.open(tmp_path / "x.png") as image:
        pixels = np.asarray(image)
    assert pixels.shape == (21, 33, 3)
    assert (pixels == 10 + index).all()
