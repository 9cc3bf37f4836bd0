"""`.arkit.csv`: the 52 ARKit weights and nine rotations, as the Live Link Face app writes and Unreal reads.

Header and order are those of the app's takes. Rotations are in radians: yaw to the subject's left, pitch up,
roll to the left are positive; no vendor's document says how the app counts them. Lost: what 52 shapes cannot
show (the fit's residual), wrinkles, the tongue but for `TongueOut`, the sound.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np

from ..core.arkit import CSV_SHAPES, INDEX, ROTATIONS
from ..face.arkit_fit import ArkitTrack
from .source import Material, WriteOptions, needed
from .table import write_lines

COLUMNS = ("Timecode", "BlendshapeCount", *CSV_SHAPES, *ROTATIONS)
COUNT = len(CSV_SHAPES) + len(ROTATIONS)
_ORDER = [INDEX[name[0].lower() + name[1:]] for name in CSV_SHAPES]


def write_arkit_csv(material: Material, path: Path, _options: WriteOptions) -> None:
    """Write one row per frame, ten decimals; raise OutputError where the head has no ARKit shapes."""
    write_lines(path, rows(needed(material.arkit), material.performance.fps))


def rows(track: ArkitTrack, fps: Fraction) -> Iterator[str]:
    """Yield the lines, the header first."""
    yield ",".join(COLUMNS)
    for number, values in enumerate(values_of(track)):
        numbers = ",".join(f"{value:.10f}" for value in values + 0.0)
        yield f"{timecode(number, fps)},{COUNT},{numbers}"


def values_of(track: ArkitTrack) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return the 61 values (frames, 61) in the order of the columns, rotations in radians."""
    angles = np.radians(np.concatenate([track.head[:, None], track.eyes], axis=1)).reshape(-1, len(ROTATIONS))
    values = np.concatenate([track.weights[:, _ORDER], angles], axis=1)
    return np.where(np.abs(values) < 5e-11, 0.0, values)


def timecode(number: int, fps: Fraction) -> str:
    """Return `HH:MM:SS:FF.mmm` of a frame: frames in the second, then thousandths of a frame."""
    time = number / fps
    whole = int(time)
    thousandths = round((time - whole) * fps * 1000)
    hours, minutes, seconds = whole // 3600 % 24, whole // 60 % 60, whole % 60
    return f"{hours:02d}:{minutes:02d}:{seconds:02d}:{thousandths // 1000:02d}.{thousandths % 1000:03d}"
