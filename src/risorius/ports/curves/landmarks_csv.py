"""`.landmarks.csv`: distances and points measured on the mesh, frame by frame."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...core.progress import Progress
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import TableRow, table_lines, write_lines

MEASURES = (
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
)
POINTS = tuple(f"{axis}{number:02d}" for number in range(68) for axis in "xyz")
COLUMNS = ("time_s", *MEASURES, *POINTS)


def write_landmarks_csv(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the time in seconds, the measures and the 68 iBUG points, mm and degrees to 1e-5.

    Skin is float32: at 100 mm that is 1e-5.
    """
    write_lines(path, table_lines(COLUMNS, _rows(take, options.progress), [6] + [5] * (len(COLUMNS) - 1)))


def _rows(take: WritableTake, progress: Progress) -> Iterator[TableRow]:
    for time, frame in zip(take.performance.times, take.faces(progress=progress), strict=True):
        yield np.concatenate([[time], np.asarray(take.measures(frame), dtype=np.float64)])


register(
    ".landmarks.csv",
    "distances and 68 points measured on the face",
    {"vertices"},
    write_landmarks_csv,
    order=7,
)
