"""`.fap`: MPEG-4 facial animation parameters (ISO/IEC 14496-2) as text, as Greta and its family read them.

A header `2.1 name fps frames`, then two lines per frame: 68 flags, and the frame's number with a whole number
for each flag that is 1. Only low-level parameters (3 to 68) are set. Lost: cheeks, chin boss, ears, wrinkles,
fractions of a unit, and frame rates that are no whole number (rounded).
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.arrays import Array, BoolArray
from ..core.performance import MAX_FPS
from ..core.progress import Progress
from ..errors import InputError, Place
from ..face.feature_points import COUNT, SHOWN, FeaturePoints
from .capture import check_length, read_lines
from .table import write_lines
from .writable import WritableTake, WriteOptions

Line = tuple[int, list[str]]
"""Where a line stands, and its words."""

VERSION = "2.1"
FARTHEST = 1_000_000  # more than a half turn in 1e-5 rad, the finest of the units
_WHOLE = re.compile(r"[+-]?[0-9]{1,9}")
FLAGS = " ".join("1" if number in SHOWN else "0" for number in range(1, COUNT + 1))


def write_fap(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write all frames, measured on the head's feature points in its own units (FAPU)."""
    write_lines(path, _lines(take, options.progress))


def _lines(take: WritableTake, progress: Progress) -> Iterator[str]:
    points, shown = FeaturePoints(take.dressed_head), np.array(SHOWN) - 1
    performance = take.performance
    yield f"{VERSION} risorius {round(performance.fps)} {len(performance.values)}"
    for number, frame in enumerate(take.faces(progress=progress)):
        values = np.round(points.values(frame)[shown]).astype(int)
        yield FLAGS
        yield f"{number} " + " ".join(map(str, values))


@dataclass(frozen=True, slots=True, eq=False)
class FapTake:
    """What a file holds: times (n,) in seconds, values (n, 68), 0 where masked out, and which are used."""

    times: Array
    values: Array
    used: BoolArray


def read_fap(path: Path) -> FapTake:
    """Read a `.fap` file with masks of 68 or 69 flags (Greta writes one more than the standard).

    A value that is masked out holds the last one. Raises InputError where the header, a mask or a count is
    wrong, or a frame's number does not come after the one before.
    """
    lines = ((at, line.split()) for at, line in read_lines(path) if line.strip())
    at, first = next(lines, (1, []))
    fps, frames = _header(first, Place(str(path), at))
    check_length(frames / fps, Place(str(path), at))
    values, used, order = array("d"), np.zeros(COUNT, bool), array("q")
    row = np.zeros(COUNT)
    for (at, mask), (line, words) in _pairs(lines, path):
        flags = _flags(mask, Place(str(path), at))
        place = Place(str(path), line)
        number, *numbers = _numbers(words, int(flags.sum()), place)
        if order and number <= order[-1]:
            raise InputError(f"frame {number} does not come after frame {order[-1]} before it", place)
        row[flags[:COUNT]] = numbers[: flags[:COUNT].sum()]
        values.extend(row)
        order.append(number)
        used |= flags[:COUNT]
    if len(order) != frames:
        message = f"holds {len(order)} frames; expected {frames}, as its header says"
        raise InputError(message, Place(str(path)))
    times = (np.array(order) - order[0]) / fps
    return FapTake(times, np.frombuffer(values).reshape(frames, COUNT), used)


def _pairs(lines: Iterator[Line], path: Path) -> Iterator[tuple[Line, Line]]:
    """Yield the mask and the values of each frame."""
    for mask in lines:
        values = next(lines, None)
        if values is None:
            raise InputError("is a mask without values; expected a line of them", Place(str(path), mask[0]))
        yield mask, values


def _header(words: list[str], place: Place) -> tuple[float, int]:
    try:
        _, _, fps, frames = words
        if not (0.0 < float(fps) <= MAX_FPS and int(frames) > 0):
            raise ValueError
        return float(fps), int(frames)
    except ValueError:
        raise InputError("is no header '2.1 name fps frames'", place) from None


def _flags(words: list[str], place: Place) -> BoolArray:
    if len(words) not in (COUNT, COUNT + 1) or not set(words) <= {"0", "1"}:
        message = f"is no mask of {COUNT} or {COUNT + 1} flags 0 or 1; it has {len(words)} words"
        raise InputError(message, place)
    return np.array([word == "1" for word in words])


def _numbers(words: list[str], expected: int, place: Place) -> list[int]:
    """Return a frame's number and its values; raise InputError for another count of them."""
    numbers = []
    for word in words:
        if not _WHOLE.fullmatch(word) or abs(int(word)) > FARTHEST:
            message = f"'{word[:30]}' is no whole number from -{FARTHEST} to {FARTHEST}"
            raise InputError(message, place)
        numbers.append(int(word))
    if len(numbers) != 1 + expected:
        message = f"has {len(numbers) - 1} values; expected {expected}, one for each flag that is 1"
        raise InputError(message, place)
    return numbers
