"""Captured faces read back: the shared parts of the readers of formats.

Files are read row by row, and only the numbers that are asked for are kept.
"""

from __future__ import annotations

import csv
import difflib
import math
from array import array
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate
from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ...core.movement import Cause, ManualCurve
from ...core.parameters import INDEX, NAMES, NEUTRAL, PARAMETERS
from ...core.score import BlendSettings, Score
from ...core.units import MAX_SECONDS
from ...errors import InputError, Place
from ..import_result import ScoreFile

Parse = Callable[[str], Sequence[float]]
"""Reads a cell; raises ValueError with the expected form."""

HEAD_ANGLES = [INDEX[f"head_{angle}"] for angle in ("pitch", "yaw", "roll")]
GAZE_ANGLES = [INDEX["gaze_pitch"], INDEX["gaze_yaw"]]
"""The columns of the head's and the gaze's angles among the parameters."""
_HELD = 1e-3  # s after its last row in which a capture keeps its values
_RESTS = 1e-4  # a parameter that never leaves its rest by more gets no curve
LARGEST = 512_000_000  # bytes
LONGEST_LINE = 1_000_000  # characters


def number(text: str, low: float = -math.inf, high: float = math.inf, unit: str = "") -> tuple[float]:
    """Read a finite number from `low` to `high`."""
    try:
        value = float(text) if text.isascii() and "_" not in text else math.nan
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError("expected a number")
    if not low <= value <= high:
        raise ValueError(f"expected {unit}{' ' if unit else ''}from {low:g} to {high:g}")
    return (value,)


def radians(text: str) -> tuple[float]:
    """Read an angle of at most a full turn."""
    return number(text, -6.2832, 6.2832, "radians")


@dataclass(frozen=True, slots=True)
class Column:
    """A wanted column: its name, the reader of its cells, and the count of numbers from each."""

    name: str
    parse: Parse = number
    width: int = 1


@dataclass(frozen=True, slots=True)
class Header:
    """The names of a file's columns, and where they stand."""

    path: Path
    line: int
    names: tuple[str, ...]
    text: str

    def place(self, name: str) -> Place:
        """Return where a column is named."""
        return Place(str(self.path), self.line, _position(self.text, self.names.index(name)))

    def require(self, wanted: Sequence[str], kind: str) -> None:
        """Raise InputError, naming the nearest column that there is, if one of `wanted` is missing."""
        for name in wanted:
            if name not in self.names:
                near = difflib.get_close_matches(name, self.names, n=1)
                there = f"; the nearest is '{near[0]}'" if near else ""
                message = f"column '{name}' of {kind} is missing{there}"
                raise InputError(message, Place(str(self.path), self.line))


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """The chosen columns of a file: `values` (rows, k), and the number of each row's line (rows,)."""

    path: Path
    names: tuple[str, ...]
    values: Array
    lines: Sequence[int]

    def of(self, names: Sequence[str]) -> Array:
        """Return columns (rows, len(names)) that hold one number each."""
        return self.values[:, [self.names.index(name) for name in names]]


def read_lines(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the lines of a text file with their numbers, without their ends; raise InputError."""
    place = Place(str(path))
    try:
        if path.stat().st_size > LARGEST:
            raise InputError(f"is larger than {LARGEST // 1_000_000} MB; expected less", place)
        with path.open(encoding="utf-8-sig", newline=None) as file:
            at = 0
            while line := file.readline(LONGEST_LINE):
                at += 1
                if len(line) == LONGEST_LINE or "\0" in line:
                    raise InputError("is not a line of text; expected a text file", Place(str(path), at))
                yield at, line.rstrip("\n")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place) from None
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text; expected a text file", place) from None


def read_table(path: Path, choose: Callable[[Header], Sequence[Column]], known: Sequence[str] = ()) -> Table:
    """Read those columns of a CSV file that `choose` wants of its header; spaces around cells do not count,
    nor does case in the names of the `known` columns.

    Raises InputError for a file that is empty or no text, a column given twice, a row of another length, and
    a cell that its column cannot read.
    """
    lines = ((at, line) for at, line in read_lines(path) if line.strip())
    header = _header(path, lines, {name.lower(): name for name in known})
    columns = choose(header)
    chosen = [(header.names.index(column.name), column) for column in columns]
    values, numbers = array("d"), array("Q")
    for at, line in lines:
        _read_row(line, header, chosen, values, Place(str(path), at))
        numbers.append(at)
    if not numbers:
        raise InputError("has a header and no rows; expected one per frame", Place(str(path)))
    names = tuple(column.name if k == 0 else "" for column in columns for k in range(column.width))
    return Table(path, names, np.frombuffer(values).reshape(len(numbers), len(names)), numbers)


def _header(path: Path, lines: Iterator[tuple[int, str]], spelled: Mapping[str, str]) -> Header:
    at, line = next(lines, (0, ""))
    if not at:
        raise InputError("is empty; expected a header and rows", Place(str(path)))
    names = tuple(spelled.get(name.lower(), name) for name in _cells(line, Place(str(path), at)))
    for k, name in enumerate(names):
        if fault := _fault_of(name, names[:k]):
            raise InputError(fault, Place(str(path), at, _position(line, k)))
    return Header(path, at, names, line)


def _fault_of(name: str, before: Sequence[str]) -> str:
    """Return the fault of a column's name by itself, if any."""
    if not name:
        return "a column has no name"
    if name[0] in "0123456789-+.":
        return f"'{name[:30]}' is not a column's name; expected a header in the first line"
    for other in (";", "\t"):
        if other in name:
            return f"columns are separated by {other!r}; expected ','"
    return f"column '{name[:30]}' is given twice" if name in before else ""


def _read_row(
    line: str, header: Header, chosen: Sequence[tuple[int, Column]], values: array[float], place: Place
) -> None:
    """Append the numbers of a row."""
    cells = _cells(line, place)
    if len(cells) != len(header.names):
        raise InputError(f"has {len(cells)} values; expected {len(header.names)}, as in the header", place)
    for index, column in chosen:
        try:
            values.extend(column.parse(cells[index]))
        except ValueError as error:
            message = f"{column.name} is '{cells[index][:30]}'; {error}"
            raise InputError(message, Place(place.file, place.line, _position(line, index))) from None


def _cells(line: str, place: Place) -> tuple[str, ...]:
    try:
        (row,) = csv.reader([line], strict=True)
    except csv.Error:
        raise InputError("has a quoted cell that is not closed; expected a quotation mark", place) from None
    return tuple(cell.strip() for cell in row)


def _position(line: str, index: int) -> int | None:
    """Return where a cell begins in its line, from 1; None if quotes hide it."""
    if '"' in line:
        return None
    cells = line.split(",")
    start = list(accumulate((len(cell) + 1 for cell in cells[:index]), initial=1))[-1]
    return start + len(cells[index]) - len(cells[index].lstrip())


def score_of_capture(times: Array, values: Array, source: str) -> ScoreFile:
    """Return `values` (frames, 46) at `times` (frames,) in seconds as one set of curves drawn by hand.

    `source` is the file's name, and becomes the curves' cause.
    """
    low, high = (np.array([getattr(p, end) for p in PARAMETERS]) for end in ("low", "high"))
    clipped = np.clip(values, low, high)
    moving = np.flatnonzero(np.abs(clipped - NEUTRAL).max(axis=0) > _RESTS)
    # Files round times, so the last frame that is performed may come a little after the last row: it holds.
    clock = [*times.tolist(), float(times[-1]) + _HELD]
    held = np.concatenate([clipped, clipped[-1:]])
    keys = {NAMES[column]: tuple(zip(clock, held[:, column].tolist(), strict=True)) for column in moving}
    curves = (ManualCurve(keys, Cause("capture", source)),) if keys else ()
    settings = BlendSettings(contact=False)
    return ScoreFile(Score(max(float(times[-1]), 1e-3), manual=curves, settings=settings))


def check_times(times: Array, path: Path, lines: Sequence[int]) -> Array:
    """Return times from 0 on; raise InputError if one does not come after the one before, or too late."""
    wrong = np.flatnonzero(np.diff(times) <= 0.0)
    if len(wrong):
        line = lines[int(wrong[0]) + 1]
        raise InputError(
            "its time does not come after the row before; expected rising times", Place(str(path), line)
        )
    check_length(float(times[-1] - times[0]), Place(str(path), lines[-1]))
    return np.asarray(times - times[0])


def check_length(seconds: float, place: Place) -> None:
    """Raise InputError for a capture that is longer than a performance can be."""
    if seconds > MAX_SECONDS:
        raise InputError(f"the capture lasts {seconds:g} s; expected at most {MAX_SECONDS:g} s", place)
