import csv
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from risorius.ports.curves.landmarks_csv import write_landmarks_csv
from risorius.ports.export_source import WritableTake, WriteOptions

EXPECTED = [
    "time_s",
    "lip_gap_mm",
    "lip_protrusion_mm",
    "mouth_width_mm",
    "jaw_drop_mm",
    "eye_gap_left_mm",
    "eye_gap_right_mm",
    "brow_inner_left_mm",
    "brow_inner_right_mm",
    "brow_outer_left_mm",
    "brow_outer_right_mm",
    "head_pitch_deg",
    "head_yaw_deg",
    "head_roll_deg",
    "gaze_pitch_deg",
    "gaze_yaw_deg",
]


def test_measures_of_another_number_are_refused(tmp_path: Path, take_of: Callable[..., WritableTake]) -> None:
    take = replace(take_of(), measure_count=1)
    with pytest.raises(ValueError, match="a row has shape"):
        write_landmarks_csv(take, tmp_path / "x.csv", WriteOptions())


def test_fewer_faces_than_frames_are_noticed(tmp_path: Path, take_of: Callable[..., WritableTake]) -> None:
    take = replace(take_of(), face_count=0)
    with pytest.raises(ValueError, match="zip"):
        write_landmarks_csv(take, tmp_path / "x.csv", WriteOptions())


def test_columns_stand_in_the_documented_order(tmp_path: Path, take_of: Callable[..., WritableTake]) -> None:
    write_landmarks_csv(take_of(), tmp_path / "x.csv", WriteOptions())
    with (tmp_path / "x.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header[:16] == EXPECTED
    assert header[16:20] == ["x00", "y00", "z00", "x01"]
    assert header[-1] == "z67"
    assert len(header) == 16 + 3 * 68
    numbers = np.array(rows, float)
    np.testing.assert_allclose(numbers[:, 0], np.arange(31) / 30, atol=1e-6)
    np.testing.assert_array_equal(numbers[:, 1:], np.arange(31)[:, None].repeat(219, 1))
