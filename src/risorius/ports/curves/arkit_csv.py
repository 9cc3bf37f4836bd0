"""`.arkit.csv`: the 52 ARKit weights and nine rotations, as the Live Link Face app writes and Unreal reads.

Header and order are those of the app's takes. The app names them `.csv`, so that suffix is read as this
format, too. Rotations are in radians: yaw to the subject's left, pitch up, roll to the left are positive; no
vendor's document says how the app counts them. Lost: what 52 shapes cannot show (the fit's residual),
wrinkles, the tongue but for `TongueOut`, the sound.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np

from ...core.arkit import CSV_SHAPES, INDEX, ROTATIONS, SHAPES, column_of
from ...core.arrays import Array
from ...core.lips.lip_rig import OPENING, seal_of
from ...core.parameters import INDEX as PARAMETER
from ...errors import InputError, unknown
from ...face.fit.arkit_direct import gaze_of
from ...face.fit.arkit_fit import ArkitFit
from ...face.fit.arkit_track import ArkitTrack
from ...face.fit.lip_file import load_lip_rig
from ...face.fit.muscle_fit import MuscleFit
from ...face.solve import FaceSolver
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..import_result import ReadOptions, ScoreFile
from ..table import write_lines
from .capture import (
    GAZE_ANGLES,
    HEAD_ANGLES,
    Column,
    Header,
    Parse,
    Table,
    check_times,
    radians,
    read_table,
    score_of_capture,
)

APP_RATE = 60.0  # frames per second of the app's takes
_CLOCK = 4  # numbers of a time code, the first of each row
_OPEN = 0.02  # share of the jaw's way: a smaller opening cannot be closed by the lips
DAY = 86_400.0  # s; a take may go on past midnight
_TIMECODE = re.compile(r"(\d{1,4}):(\d{2}):(\d{2})[:;](\d{1,6}(?:\.\d{1,9})?)")
COLUMNS = ("Timecode", "BlendshapeCount", *CSV_SHAPES, *ROTATIONS)
COUNT = len(CSV_SHAPES) + len(ROTATIONS)
_ORDER = [INDEX[name[0].lower() + name[1:]] for name in CSV_SHAPES]


def write_arkit_csv(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write one row per frame, ten decimals; raise OutputError if the head has no ARKit shapes."""
    write_lines(path, rows(take.fit_arkit(options.progress), take.performance.fps))


def rows(track: ArkitTrack, fps: Fraction) -> Iterator[str]:
    """Yield the lines, the header first."""
    yield ",".join(COLUMNS)
    for number, values in enumerate(values_of(track)):
        numbers = ",".join(f"{value:.10f}" for value in values)
        yield f"{timecode(number, fps)},{COUNT},{numbers}"


def values_of(track: ArkitTrack) -> Array:
    """Return the 61 values (frames, 61) in the order of the columns, rotations in radians."""
    values = np.concatenate([track.weights[:, _ORDER], track.rotations], axis=1)
    return np.where(np.abs(values) < 5e-11, 0.0, values)


def timecode(number: int, fps: Fraction) -> str:
    """Return `HH:MM:SS:FF.mmm` of a frame: frames in the second, then thousandths of a frame."""
    time = number / fps
    whole = int(time)
    thousandths = round((time - whole) * fps * 1000)
    hours, minutes, seconds = whole // 3600 % 24, whole // 60 % 60, whole % 60
    return f"{hours:02d}:{minutes:02d}:{seconds:02d}:{thousandths // 1000:02d}.{thousandths % 1000:03d}"


@dataclass(frozen=True, slots=True, eq=False)
class ArkitTake:
    """Values of a CSV: times (n,) in seconds, weights (n, 52) in ARKit's order, rotations (n, 9) radians."""

    times: Array
    weights: Array
    rotations: Array


def read_arkit_csv(path: Path) -> ArkitTake:
    """Read a take of Live Link Face, or one written here; columns are found by name, in any order.

    Weights are brought within 0 to 1; missing rotations are 0. Raises InputError for a column that is
    missing or unknown, a row whose count of values is wrong, a cell that is not a number or an angle, and a
    time code that cannot be read or goes back.
    """
    table = read_table(path, _columns, COLUMNS)
    weights = table.values[:, _CLOCK : _CLOCK + len(SHAPES)]
    np.clip(weights, 0.0, 1.0, out=weights)  # long takes are large: their numbers are held once
    turned = [name for name in ROTATIONS if name in table.names]
    rotations = np.zeros((len(weights), len(ROTATIONS)))
    rotations[:, [ROTATIONS.index(name) for name in turned]] = table.of(turned)
    return ArkitTake(_times(table), weights, rotations)


def read_arkit_capture(path: Path, options: ReadOptions) -> ScoreFile:
    """Fit a take's weights to the head's muscles; raises as `read_arkit_csv`."""
    take = read_arkit_csv(path)
    options.progress("Fitting muscles …")
    head = options.head()
    fit = ArkitFit.of(head)
    open_, close = take.weights[:, INDEX["jawOpen"]], take.weights[:, INDEX["mouthClose"]]
    # Lips that are closed over an open jaw are brought together by contact, not by muscles against the jaw.
    apart = take.weights.copy()
    apart[:, INDEX["mouthClose"]] = 0.0
    responses = MuscleFit(FaceSolver(head), lambda frame: fit.displacement(frame.skin))
    values = responses.of_shapes(apart, fit.visible_displacement(np.eye(len(INDEX))))
    closed = np.where(open_ > _OPEN, np.minimum(close / np.maximum(open_, _OPEN), 1.0), 0.0)
    gap = load_lip_rig(head.folder).gap({name: values[:, PARAMETER[name]] for name in OPENING})
    gap = np.maximum(gap, 0.0)
    seal = seal_of(closed * gap, (1.0 - closed) * gap)
    # A fully closed mouth stays closed, however wide the jaw's gap.
    values[:, PARAMETER["lip_seal"]] = np.where(closed < 1.0, seal, 1.0)
    values[:, PARAMETER["tongue_out"]] = take.weights[:, INDEX["tongueOut"]]
    degrees = np.degrees(take.rotations)
    values[:, HEAD_ANGLES] = degrees[:, [1, 0, 2]]
    eyes = degrees[:, 3:].reshape(-1, 2, 3).mean(axis=1)
    looked = eyes[:, [1, 0]] if np.any(degrees[:, 3:]) else np.stack(gaze_of(take.weights), axis=1)
    values[:, GAZE_ANGLES] = looked
    return score_of_capture(take.times, values, path.name)


def _columns(header: Header) -> list[Column]:
    for name in header.names:
        if name not in COLUMNS:
            raise InputError(unknown("column", name, COLUMNS), header.place(name))
    header.require(("Timecode", *CSV_SHAPES), "a Live Link Face take")
    turned = [Column(name, radians) for name in ROTATIONS if name in header.names]
    columns = [Column("Timecode", _clock, _CLOCK), *map(Column, map(column_of, SHAPES)), *turned]
    if "BlendshapeCount" in header.names:
        here = len(header.names) - 2
        columns.append(Column("BlendshapeCount", _counter({str(here), str(COUNT)}, here), 0))
    return columns


def _counter(right: Collection[str], here: int) -> Parse:
    """Return the check that a row gives its number of values; nothing is kept of it."""

    def check(text: str) -> tuple[()]:
        if text not in right:
            raise ValueError(f"expected {here}, the number of columns")
        return ()

    return check


def _clock(text: str) -> tuple[float, ...]:
    match = _TIMECODE.fullmatch(text)
    if match is None:
        raise ValueError("expected a time code HH:MM:SS:FF.mmm")
    return tuple(float(part) for part in match.groups())


def _times(table: Table) -> Array:
    clock = table.values[:, :_CLOCK]
    seconds = clock[:, :3] @ [3600.0, 60.0, 1.0]
    seconds += DAY * np.cumsum(np.diff(seconds, prepend=seconds[0]) < -0.5 * DAY)
    return check_times(seconds + clock[:, 3] / _rate(seconds, clock[:, 3]), table.path, table.lines)


def _rate(seconds: Array, frames: Array) -> float:
    """Return the frames of a second: as fit evenly if one ends, or the app's rate."""
    step, whole = np.diff(frames), np.diff(seconds)
    ends = whole == 1.0
    if not ends.any():
        return APP_RATE
    usual = float(np.median(step[whole == 0.0])) if (whole == 0.0).any() else 1.0
    return max(round(float(np.median(usual - step[ends])), 2), 1.0)


register(
    ".arkit.csv",
    "52 ARKit weights as Live Link Face writes them",
    {"head"},
    write_arkit_csv,
    read_arkit_capture,
    also_read=(".csv",),
)
