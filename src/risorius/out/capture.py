"""Captured faces read back: what the readers of formats have in common."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..errors import InputError, Place, unknown

Array = npt.NDArray[np.float64]

LARGEST = 512_000_000  # bytes


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Rows of a CSV file: columns by name, cells as text, and the number of each row's line."""

    path: Path
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]

    def texts(self, column: str) -> list[str]:
        """Return the cells of a column."""
        index = self.columns.index(column)
        return [row[index] for row in self.rows]

    def numbers(self, names: Sequence[str]) -> Array:
        """Return columns as numbers (rows, len(names)); raise InputError where a cell is none."""
        places = [self.columns.index(name) for name in names]
        result = np.empty((len(self.rows), len(names)))
        for k, (row, line) in enumerate(zip(self.rows, self.lines, strict=True)):
            for c, place in enumerate(places):
                result[k, c] = self._number(row[place], names[c], line)
        return result

    def _number(self, text: str, name: str, line: int) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            message = f"{name} is '{text[:20]}'; expected a number"
            raise InputError(message, Place(str(self.path), line))
        return value


def read_lines(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the lines of a text file with their numbers, without their ends; raise InputError."""
    place = Place(str(path))
    try:
        if path.stat().st_size > LARGEST:
            raise InputError(f"is larger than {LARGEST // 1_000_000} MB; expected less", place)
        with path.open(encoding="utf-8-sig", newline=None) as file:
            for number, line in enumerate(file, 1):
                yield number, line.rstrip("\n")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place) from None
    except UnicodeDecodeError:
        raise InputError("is no UTF-8 text; expected a text file", place) from None


def read_table(path: Path) -> Table:
    """Read a CSV file with a header; spaces around names and cells do not count.

    Raises InputError for a file that is empty or no text, a column given twice, and a row of another length.
    """
    lines = [(number, line) for number, line in read_lines(path) if line.strip()]
    if not lines:
        raise InputError("is empty; expected a header and rows", Place(str(path)))
    parsed = [tuple(cell.strip() for cell in row) for row in csv.reader(line for _, line in lines)]
    header, rows = parsed[0], parsed[1:]
    if twice := sorted({name for name in header if header.count(name) > 1}):
        raise InputError(f"column '{twice[0]}' is given twice", Place(str(path), lines[0][0]))
    if not rows:
        raise InputError("has a header and no rows; expected one per frame", Place(str(path)))
    numbers = tuple(number for number, _ in lines[1:])
    for number, row in zip(numbers, rows, strict=True):
        if len(row) != len(header):
            message = f"has {len(row)} values; expected {len(header)}, as the header"
            raise InputError(message, Place(str(path), number))
    return Table(path, header, tuple(rows), numbers)


def require(table: Table, wanted: Sequence[str], kind: str) -> None:
    """Raise InputError, naming the nearest column that there is, where one of `wanted` is missing."""
    for name in wanted:
        if name not in table.columns:
            message = f"column '{name}' of {kind} is missing; {unknown('column', name, table.columns)}"
            raise InputError(message, Place(str(table.path), 1))


def check_times(times: Array, path: Path, lines: Sequence[int]) -> Array:
    """Return times from 0 on; raise InputError where one does not come after the one before."""
    wrong = np.flatnonzero(np.diff(times) <= 0.0)
    if len(wrong):
        line = lines[int(wrong[0]) + 1]
        raise InputError("its time does not come after the row before", Place(str(path), line))
    return np.asarray(times - times[0])
