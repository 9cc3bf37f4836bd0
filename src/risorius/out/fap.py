"""`.fap`: MPEG-4 facial animation parameters (ISO/IEC 14496-2) as text, as Greta and its family read them.

A header `2.1 name fps frames`, then two lines per frame: 68 flags, and the frame's number with a whole number
for each flag that is 1. Only low-level parameters (3 to 68) are set. Lost: cheeks, chin boss, ears, wrinkles,
fractions of a unit, and frame rates that are no whole number (rounded).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..errors import InputError, Place
from ..face.feature_points import COUNT, SHOWN, FeaturePoints
from .capture import read_lines
from .source import Material, WriteOptions, needed
from .table import write_lines

VERSION = "2.1"
FLAGS = " ".join("1" if number in SHOWN else "0" for number in range(1, COUNT + 1))


def write_fap(material: Material, path: Path, _options: WriteOptions) -> None:
    """Write all frames, measured on the head's feature points in its own units (FAPU)."""
    write_lines(path, _lines(material))


def _lines(material: Material) -> Iterator[str]:
    points, shown = FeaturePoints(needed(material.head)), np.array(SHOWN) - 1
    performance = material.performance
    yield f"{VERSION} risorius {round(performance.fps)} {len(performance.values)}"
    for number, frame in enumerate(material.frames()):
        values = np.round(points.values(frame)[shown]).astype(int)
        yield FLAGS
        yield f"{number} " + " ".join(map(str, values))


@dataclass(frozen=True, slots=True, eq=False)
class FapTake:
    """What a file holds: frames per second, values (n, 68) with 0 where masked out, and which are used."""

    fps: float
    values: npt.NDArray[np.float64]
    used: npt.NDArray[np.bool_]


def read_fap(path: Path) -> FapTake:
    """Read a `.fap` file with masks of 68 or 69 flags (Greta writes one more than the standard).

    Frames that are left out hold the last values. Raises InputError where the header, a mask or a count is
    wrong.
    """
    lines = [(number, line.split()) for number, line in read_lines(path) if line.strip()]
    fps, frames = _header(lines, path)
    if len(lines) != 1 + 2 * frames:
        expected = f"expected {1 + 2 * frames} for {frames} frames"
        raise InputError(f"has {len(lines)} lines; {expected}", Place(str(path)))
    values, used = np.zeros((frames, COUNT)), np.zeros(COUNT, bool)
    for k in range(frames):
        (at, mask), (line, row) = lines[1 + 2 * k : 3 + 2 * k]
        flags = _flags(mask, Place(str(path), at))
        numbers = _whole(row, Place(str(path), line))
        if len(numbers) != 1 + flags.sum():
            message = f"has {len(numbers) - 1} values; expected {flags.sum()}, one for each flag that is 1"
            raise InputError(message, Place(str(path), line))
        values[k] = values[k - 1] if k else 0.0
        values[k, flags[:COUNT]] = numbers[1:][: flags[:COUNT].sum()]
        used |= flags[:COUNT]
    return FapTake(fps, values, used)


def _header(lines: list[tuple[int, list[str]]], path: Path) -> tuple[float, int]:
    try:
        _, _, fps, frames = lines[0][1]
        if not (0.0 < float(fps) <= 1000.0 and int(frames) > 0):
            raise ValueError
        return float(fps), int(frames)
    except (ValueError, IndexError):
        raise InputError("is no header '2.1 name fps frames'", Place(str(path), 1)) from None


def _flags(words: list[str], place: Place) -> npt.NDArray[np.bool_]:
    if len(words) not in (COUNT, COUNT + 1) or not set(words) <= {"0", "1"}:
        raise InputError(f"is no mask of {COUNT} or {COUNT + 1} flags 0 or 1", place)
    return np.array([word == "1" for word in words])


def _whole(words: list[str], place: Place) -> list[int]:
    try:
        return [int(word) for word in words]
    except ValueError:
        raise InputError("holds a word that is no whole number", place) from None
