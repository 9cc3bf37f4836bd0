"""`.fap`: MPEG-4 facial animation parameters (ISO/IEC 14496-2) as text, as Greta and its family read them.

A header `2.1 name fps frames`, then two lines per frame: 68 flags, and the frame's number with a whole number
for each flag that is 1. Only low-level parameters (3 to 68) are set. Lost: closures (nothing says that lips
touch over a low jaw), cheeks, chin boss, ears, wrinkles, fractions of a unit, and frame rates that are not
whole numbers (rounded).
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...core.arrays import Array, BoolArray
from ...core.frame_rate import MAX_FPS
from ...core.parameters import INDEX, NEUTRAL
from ...core.progress import Progress
from ...errors import InputError, Place, warn
from ...face.fit.feature_points import ANGLE, COUNT, LIDS, POINTS, SHOWN, TONGUE, FeaturePoints
from ...face.fit.muscle_fit import TONGUE as TONGUE_FITTED
from ...face.fit.muscle_fit import MuscleFit
from ...face.solve import FaceSolver
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..import_result import ReadOptions, ScoreFile
from ..table import write_lines
from .capture import GAZE_ANGLES, HEAD_ANGLES, check_length, read_lines, score_of_capture

NumberedWords = tuple[int, list[str]]
"""The number of a line in the file, and its words."""

VERSION = "2.1"
FARTHEST = 1_000_000  # more than a half turn in 1e-5 rad, the finest of the units
_COUNT = re.compile(r"[0-9]{1,9}")
_WHOLE = re.compile(r"[+-]?[0-9]{1,9}")
FLAGS = " ".join("1" if number in SHOWN else "0" for number in range(1, COUNT + 1))


def write_fap(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write all frames, measured on the head's feature points in its own units (FAPU)."""
    write_lines(path, _lines(take, options.progress))


def _lines(take: WritableTake, progress: Progress) -> Iterator[str]:
    points, shown = FeaturePoints(take.shown_head), np.array(SHOWN) - 1
    performance = take.performance
    yield f"{VERSION} risorius {round(performance.fps)} {len(performance.values)}"
    for number, frame in enumerate(take.faces(progress=progress)):
        values = np.round(points.values(frame)[shown]).astype(int)
        yield FLAGS
        yield f"{number} " + " ".join(map(str, values))


@dataclass(frozen=True, slots=True, eq=False)
class FapTake:
    """The values of a file: times (n,) in seconds, values (n, 68), 0 where masked out, and which are used."""

    times: Array
    values: Array
    used: BoolArray


def read_fap(path: Path) -> FapTake:
    """Read a `.fap` file with masks of 68 or 69 flags (Greta writes one more than the standard).

    A value that is masked out holds the last one. Raises InputError if the header, a mask or a count is
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


def read_fap_capture(path: Path, options: ReadOptions) -> ScoreFile:
    """Fit a file's feature points to the head's muscles; raises as `read_fap`."""
    take = read_fap(path)
    options.progress("Fitting muscles …")
    head = options.head()
    points, solver = FeaturePoints(head), FaceSolver(head)
    sizes = points.sizes()
    rows = [number - 1 for number in (*POINTS, *LIDS) if take.used[number - 1]]
    responses = MuscleFit(solver, lambda frame: points.of_skin(frame.skin) * sizes)
    values = responses.values(take.values * sizes, rows) if rows else np.tile(NEUTRAL, (len(take.times), 1))
    tongue = [number - 1 for number in TONGUE]
    if take.used[tongue].all():
        tip = MuscleFit(solver, points.tongue_tip, TONGUE_FITTED).values(take.values[:, tongue], (0, 1))
        places = [INDEX[name] for name in TONGUE_FITTED]
        values[:, places] = tip[:, places]
    _warn_of_left_out(take, path)
    angles = np.degrees(take.values * ANGLE)
    values[:, HEAD_ANGLES] = angles[:, 47:50] * [-1.0, 1.0, -1.0]
    values[:, GAZE_ANGLES] = np.stack([-angles[:, 24:26].mean(axis=1), angles[:, 22:24].mean(axis=1)], axis=1)
    return score_of_capture(take.times, values, path.name)


def _warn_of_left_out(take: FapTake, path: Path) -> None:
    """Warn of parameters that do something in a file, and nothing in our face."""
    moved = np.flatnonzero(take.values.any(axis=0)) + 1
    left_out = sorted({int(number) for number in moved} - set(SHOWN))
    if left_out:
        named = ", ".join(map(str, left_out))
        warn(f"{path}: FAP {named} cannot be shown; left out")


def _pairs(lines: Iterator[NumberedWords], path: Path) -> Iterator[tuple[NumberedWords, NumberedWords]]:
    """Yield the mask and the values of each frame."""
    for mask in lines:
        values = next(lines, None)
        if values is None:
            raise InputError("is a mask without values; expected a line of them", Place(str(path), mask[0]))
        yield mask, values


def _header(words: list[str], place: Place) -> tuple[float, int]:
    try:
        _, _, fps, frames = words
        if not (0.0 < float(fps) <= MAX_FPS and _COUNT.fullmatch(frames) and int(frames) > 0):
            raise ValueError
        return float(fps), int(frames)
    except ValueError:
        raise InputError("is not a header; expected '2.1 name fps frames'", place) from None


def _flags(words: list[str], place: Place) -> BoolArray:
    if len(words) not in (COUNT, COUNT + 1) or not set(words) <= {"0", "1"}:
        message = f"is not a mask: it has {len(words)} words; expected {COUNT} or {COUNT + 1} flags 0 or 1"
        raise InputError(message, place)
    return np.array([word == "1" for word in words])


def _numbers(words: list[str], expected: int, place: Place) -> list[int]:
    """Return a frame's number and its values; raise InputError for another count of them."""
    numbers = []
    for word in words:
        if not _WHOLE.fullmatch(word) or abs(int(word)) > FARTHEST:
            message = f"'{word[:30]}' cannot be used; expected a whole number from -{FARTHEST} to {FARTHEST}"
            raise InputError(message, place)
        numbers.append(int(word))
    if len(numbers) != 1 + expected:
        message = f"has {len(numbers) - 1} values; expected {expected}, one for each flag that is 1"
        raise InputError(message, place)
    return numbers


register(".fap", "MPEG-4 facial animation parameters", {"head"}, write_fap, read_fap_capture)
