"""`.au.csv`: action units, gaze and head pose in the columns of OpenFace 2.x (sequences).

Intensities `AUnn_r` run from 0 to 5, presences `AUnn_c` are 1 from intensity 1 on. Axes are those of a
camera: x to the picture's right, y down, z away; the face looks at it from `DISTANCE` mm; angles in radians,
the pose's as Rx·Ry·Rz. `AU25` is measured on the lips. Lost: closures (nothing says that lips touch over a
low jaw), sides, phones' shapes of the lips but for the units' own, units that OpenFace does not know,
wrinkles. OpenFace's eye and face landmarks are left out, as it may itself.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.action_units import action_unit, resolve_targets
from ...core.arrays import Array, Int64Array
from ...core.parameters import INDEX, NEUTRAL
from ...core.progress import Progress
from ...errors import InputError, Place, unknown
from ...face.frame import FaceFrame
from ...face.numerics.rotations import about_axis, rotation_angles
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..import_result import ReadOptions, ScoreFile
from ..table import write_lines
from .action_unit_fit import ActionUnitFit
from .capture import (
    GAZE_ANGLES,
    HEAD_ANGLES,
    Column,
    Header,
    Table,
    check_film_times,
    column_names,
    radians,
    read_table,
    rows_of_face,
    score_of_capture,
)
from .landmarks_csv import MEASURES

INTENSITIES = (1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 20, 23, 25, 26, 45)
PRESENCES = (1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 20, 23, 25, 26, 28, 45)
SCALE, PRESENT = 5.0, 1.0
DISTANCE = 800.0
_PARTED = 8.0  # mm of lip gap at which lips are parted as far as the scale goes
_GAZE = (*(f"gaze_{eye}_{axis}" for eye in (0, 1) for axis in "xyz"), "gaze_angle_x", "gaze_angle_y")
_POSE = (*(f"pose_T{axis}" for axis in "xyz"), *(f"pose_R{axis}" for axis in "xyz"))
_FACE = "face_id"
_PLAIN = ("timestamp", "success", _FACE)
_MISSPELT = 0.85  # how alike a name is to that of a column which is not there, to be taken for it
_TURNED, _LOOKED = _POSE[3:], _GAZE[6:]
_UNIT = re.compile(r"AU\d{1,9}_r")
COLUMNS = (
    *("frame", "face_id", "timestamp", "confidence", "success", *_GAZE, *_POSE),
    *(f"AU{number:02d}_r" for number in INTENSITIES),
    *(f"AU{number:02d}_c" for number in PRESENCES),
)
CAMERA = np.diag([1.0, -1.0, -1.0])
"""From the head's axes to the camera's, and back."""


def write_au_csv(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write one row per frame, counted from 1."""
    write_lines(path, _lines(take, options.progress))


def _lines(take: WritableTake, progress: Progress) -> Iterator[str]:
    numbers = tuple(dict.fromkeys((*INTENSITIES, *PRESENCES)))
    # Units outside the columns take up what they do, so that no other unit has to.
    fit = ActionUnitFit((*numbers, 16, 22, 24, 11))
    units = fit.intensities(take.performance.values)[:, : len(numbers)]
    gap = MEASURES.index("lip_gap_mm")
    yield ", ".join(COLUMNS)
    rows = zip(take.performance.times, units, take.faces(progress=progress), strict=True)
    for number, (time, is_face, frame) in enumerate(rows, 1):
        strength = dict(zip(numbers, SCALE * is_face, strict=True))
        strength[25] = max(strength[25], SCALE * min(float(take.measures(frame)[gap]) / _PARTED, 1.0))
        parts = [f"{number}", "0", f"{time:.3f}", "1.00", "1", *(f"{v + 0.0:.6f}" for v in _seen(frame))]
        parts += [f"{strength[au]:.2f}" for au in INTENSITIES]
        parts += ["1" if strength[au] >= PRESENT else "0" for au in PRESENCES]
        yield ", ".join(parts)


def _seen(frame: FaceFrame) -> Array:
    """Return gaze and pose in the camera's axes; eye 0 is the one on the picture's left, the right eye."""
    turn = CAMERA @ frame.head_rotation @ CAMERA
    left, right = (CAMERA @ frame.head_rotation @ eye[:, 2] for eye in frame.eye_rotation)
    mean = left + right
    angles = np.arctan2(mean[:2], -mean[2])
    numbers = np.concatenate([right, left, angles, [0.0, 0.0, DISTANCE], pose_angles(turn)])
    return np.where(np.abs(numbers) < 5e-7, 0.0, numbers)


def pose_angles(turn: Array) -> tuple[float, float, float]:
    """Return (x, y, z) in radians with Rx·Ry·Rz = `turn` (3, 3)."""
    y = np.arcsin(np.clip(turn[0, 2], -1.0, 1.0))
    return (
        float(np.arctan2(-turn[1, 2], turn[2, 2])),
        float(y),
        float(np.arctan2(-turn[0, 1], turn[0, 0])),
    )


@dataclass(frozen=True, slots=True, eq=False)
class ActionUnitTake:
    """Values of a CSV: times (n,) s, intensities (n,) 0..1 by unit, head and gaze (n, 3) and (n, 2) degrees.

    `head` is pitch, yaw, roll, `gaze` pitch and yaw of the eyes in the head.
    """

    times: Array
    units: dict[int, Array]
    head: Array
    gaze: Array


def read_au_csv(path: Path, face: int | None = None) -> ActionUnitTake:
    """Read action units, pose and gaze of OpenFace's CSV (a sequence's); others are passed over.

    `face`: the number of the face (`face_id`), if the file has several. Times are those of the film. Frames
    in which no face was found (`success` 0) hold the one before. Raises InputError for columns that are
    missing, units that we do not know, and cells that are not numbers.
    """
    table = rows_of_face(read_table(path, _columns, COLUMNS), _FACE, face)
    units = {int(name[2:-2]): name for name in table.names if _UNIT.fullmatch(name)}
    found = _held(table)
    strengths = np.clip(table.of(list(units.values()))[found] / SCALE, 0.0, 1.0)
    times = check_film_times(table.of(["timestamp"])[:, 0], path, table.lines)
    turns = [turn_of(row) for row in _block(table, _TURNED)[found]]
    head = np.array([rotation_angles(CAMERA @ turn @ CAMERA) for turn in turns])
    gaze = _gaze(_block(table, _LOOKED)[found], turns)
    return ActionUnitTake(times, dict(zip(units, strengths.T, strict=True)), head, gaze)


def is_openface(path: Path) -> bool:
    """Tell whether a CSV file has OpenFace's columns, whatever its name; raise InputError for other files."""
    names = column_names(path)
    return "timestamp" in names and any(_UNIT.fullmatch(name.replace("au", "AU")) for name in names)


def read_au_capture(path: Path, options: ReadOptions) -> ScoreFile:
    """Return the muscles of a file's action units; raises as `read_au_csv`."""
    take = read_au_csv(path, options.face)
    values = np.tile(NEUTRAL, (len(take.times), 1))
    for k, row in enumerate(values):
        units = {f"AU{number}": float(strength[k]) for number, strength in take.units.items()}
        for name, value in resolve_targets(units).items():
            row[INDEX[name]] = value
    values[:, HEAD_ANGLES], values[:, GAZE_ANGLES] = take.head, take.gaze
    return score_of_capture(take.times, values, path.name)


def _columns(header: Header) -> list[Column]:
    units = [name for name in header.names if _UNIT.fullmatch(name)]
    header.require(("timestamp", *([] if units else ["AU01_r"])), "OpenFace")
    absent = sorted({*_PLAIN, *_TURNED, *_LOOKED} - set(header.names))
    for name in (name for name in header.names if name not in COLUMNS):
        strange = name.startswith("AU") and not re.fullmatch(r"AU\d{1,9}_[rc]", name)
        if strange or difflib.get_close_matches(name, absent, 1, _MISSPELT):
            raise InputError(unknown("column", name, COLUMNS), header.place(name))
    for name in units:
        try:
            action_unit(f"AU{int(name[2:-2])}")
        except InputError as error:
            raise error.at(header.place(name)) from None
    plain = [name for name in (*_PLAIN, *units) if name in header.names]
    angles = [name for block in (_TURNED, _LOOKED) if _whole(header, block) for name in block]
    return [*map(Column, plain), *(Column(name, radians) for name in angles)]


def _whole(header: Header, block: Sequence[str]) -> bool:
    """Return whether all columns of a block are there, not none; raise InputError for a part."""
    if not set(block) & set(header.names):
        return False
    header.require(block, "OpenFace")
    return True


def _held(table: Table) -> Int64Array:
    """Return for each row (n,) the last one up to it in which a face was found."""
    rows = np.arange(len(table.values))
    if "success" not in table.names:
        return rows
    good = table.of(["success"])[:, 0] > 0.0
    if not good.any():
        raise InputError("no row has success 1; expected a face", Place(str(table.path)))
    first = int(np.argmax(good))
    return np.maximum.accumulate(np.where(good, rows, first))


def _block(table: Table, names: Sequence[str]) -> Array:
    if names[0] not in table.names:
        return np.zeros((len(table.values), len(names)))
    return table.of(names)


def turn_of(angles: Array) -> Array:
    """Return Rx·Ry·Rz (3, 3) of angles in radians, the inverse of `pose_angles`."""
    x, y, z = (about_axis(axis, float(angle)) for axis, angle in zip(np.eye(3), angles, strict=True))
    return np.asarray(x @ y @ z)


def _gaze(angles: Array, turns: list[Array]) -> Array:
    """Return pitch and yaw (n, 2) in the head of gaze angles (n, 2) against the camera."""
    across, down = np.tan(angles).T
    ahead = np.stack([across, down, -np.ones(len(angles))], axis=1)
    local = [CAMERA @ turn.T @ way for turn, way in zip(turns, ahead, strict=True)]
    x, y, z = np.array(local).T
    pitch, yaw = np.arctan2(y, np.hypot(x, z)), np.arctan2(x, z)
    return np.asarray(np.degrees(np.stack([pitch, yaw], axis=1)))


register(
    ".au.csv", "action units, gaze and pose in OpenFace's columns", {"head"}, write_au_csv, read_au_capture
)
