import csv
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from risorius.core.parameters import NAMES
from risorius.ports.curves.muscles_csv import write_muscles_csv
from risorius.ports.export_source import WritableTake, WriteOptions


@pytest.mark.parametrize("fps", [Fraction(30), Fraction(24000, 1001)])
def test_curves_are_read_back_to_a_millionth(
    tmp_path: Path, take_of: Callable[..., WritableTake], fps: Fraction
) -> None:
    take = take_of(duration=3.0, fps=fps)
    write_muscles_csv(take, tmp_path / "x.csv", WriteOptions())
    with (tmp_path / "x.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["time_s", *NAMES]
    numbers = np.array(rows, float)
    np.testing.assert_allclose(numbers[:, 0], take.performance.times, atol=1e-6)
    np.testing.assert_allclose(numbers[:, 1:], take.performance.values, atol=1e-6)
