"""Manifests: the rows of a `.csv` or `.jsonl` file, or of a folder of recordings, read one at a time.

A row that cannot be read is an error in its place among the rows, and the next one follows. Memory does not
grow with the manifest.
"""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from ..errors import InputError, Place, RisoriusError
from ..machine.paths import exists, is_utf8
from ..reading.json_text import parse_json
from ..script.suffixes import RECORDING_SUFFIXES

LONGEST_LINE = 1_000_000  # bytes
LABEL_SUFFIXES = (".textgrid", ".lab", ".txt")
"""Suffixes of the file beside a recording that gives its words; the first that exists is used."""


@dataclass(frozen=True, slots=True)
class ManifestRow:
    """A row: where it stands, and its cells by column; a column that the row leaves empty is missing."""

    place: Place
    cells: Mapping[str, str]


Rows = Iterator[ManifestRow | RisoriusError]


@dataclass(frozen=True)
class Manifest:
    """A manifest file or folder. Each `rows()` reads it anew."""

    path: Path

    def __post_init__(self) -> None:
        if not is_utf8(str(self.path)):
            raise InputError("is not named in UTF-8; expected a name that can be written down", self._place)
        if not exists(self.path):
            raise InputError(
                "there is no such manifest; expected a .csv or .jsonl file, or a folder", self._place
            )
        if not self.path.is_dir() and self.path.suffix.lower() not in _READERS:
            raise InputError("is not a manifest; expected a .csv or .jsonl file, or a folder", self._place)

    @property
    def folder(self) -> Path:
        """The folder from which the names of files in the manifest count."""
        return self.path if self.path.is_dir() else self.path.parent

    @property
    def _place(self) -> Place:
        return Place(str(self.path))

    def rows(self) -> Rows:
        """Yield all rows, in place of one that cannot be read the error that says why."""
        if self.path.is_dir():
            is_empty = True
            for row in _recordings(self.path):
                is_empty = False
                yield row
            if is_empty:
                raise InputError("holds no recording; expected e.g. a.wav beside a.txt", self._place)
            return
        try:
            file = self.path.open("rb")
        except OSError as error:
            raise InputError(f"cannot be read: {error.strerror}", self._place) from None
        with file:
            yield from _READERS[self.path.suffix.lower()](_Lines(file, str(self.path)))


@dataclass
class _Lines:
    """The lines of a file as text; one that is too long or not UTF-8 raises InputError, the next is read."""

    file: BinaryIO
    name: str
    number: int = 0

    def __iter__(self) -> _Lines:
        return self

    def __next__(self) -> str:
        line = self.file.readline(LONGEST_LINE + 1)
        if not line:
            raise StopIteration
        self.number += 1
        if len(line) > LONGEST_LINE:
            while line and not line.endswith(b"\n"):
                line = self.file.readline(LONGEST_LINE)
            raise InputError(f"is longer than {LONGEST_LINE:,} bytes; expected less", self.place)
        if b"\0" in line:
            raise InputError("holds a null character; expected text", self.place)
        try:
            return line.decode("utf-8-sig" if self.number == 1 else "utf-8")
        except UnicodeDecodeError as error:
            raise InputError(f"is not UTF-8 (byte 0x{line[error.start]:02x})", self.place) from None

    @property
    def place(self) -> Place:
        """The line that was read last."""
        return Place(self.name, self.number)

    def mark(self) -> tuple[int, int]:
        """Return the present position, for `back_to`."""
        return self.file.tell(), self.number

    def back_to(self, mark: tuple[int, int]) -> None:
        """Read on from a position."""
        self.file.seek(mark[0])
        self.number = mark[1]


def _csv_rows(lines: _Lines) -> Rows:
    reader = csv.reader(lines, strict=True)
    try:
        header = [name.strip() for name in next(reader)]
    except StopIteration:
        raise InputError("is empty; expected a line with the names of columns", Place(lines.name)) from None
    except csv.Error as error:
        raise InputError(f"is not CSV: {error}", Place(lines.name, 1)) from None
    _check_header(header, Place(lines.name, 1))
    while True:
        before = lines.mark()
        place = Place(lines.name, lines.number + 1)
        try:
            cells = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            yield InputError(f"is not CSV: {error}", place)
            _skip_one(lines, before)
        except InputError as error:
            yield error
        else:
            if any(map(str.strip, cells)):
                yield _row_of_cells(header, cells, place)


def _skip_one(lines: _Lines, before: tuple[int, int]) -> None:
    """Read on after the first line of a row that went wrong: a quote left open swallowed those after it."""
    lines.back_to(before)
    with suppress(InputError):
        next(lines, None)


def _row_of_cells(header: Sequence[str], cells: Sequence[str], place: Place) -> ManifestRow | InputError:
    if len(cells) != len(header):
        return InputError(f"has {len(cells)} cells; expected {len(header)}, one per column", place)
    named = zip(header, cells, strict=True)
    return ManifestRow(place, {name: cell for name, cell in named if cell.strip()})


def _check_header(header: Sequence[str], place: Place) -> None:
    for number, name in enumerate(header, 1):
        if not name:
            raise InputError(f"column {number} has no name; expected one", place)
        if name in header[: number - 1]:
            raise InputError(f"the column '{name}' is there twice; expected it once", place)


def _json_rows(lines: _Lines) -> Rows:
    while True:
        try:
            line = next(lines)
        except StopIteration:
            return
        except InputError as error:
            yield error
            continue
        if line.strip():
            try:
                data = parse_json(line, lines.name).data
                yield ManifestRow(lines.place, cells_of(data))
            except RisoriusError as error:
                column = error.place.column if error.place else None
                yield InputError(error.message, Place(lines.name, lines.number, column))


def cells_of(data: object) -> dict[str, str]:
    """Return the cells of a row given as an object: numbers, switches and lists as they stand in CSV.

    Raises InputError for what has no such form.
    """
    if not isinstance(data, Mapping):
        raise InputError('is not an object; expected {"id": …, "text": …}')
    cells = {str(name): _text(str(name), value) for name, value in data.items()}
    return {name: cell for name, cell in cells.items() if cell.strip()}


def _text(name: str, value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, list | tuple):
        return ";".join(_text(name, item) for item in value)
    if isinstance(value, Mapping):
        return ";".join(f"{key}:{_text(name, item)}" for key, item in value.items())
    if isinstance(value, str | os.PathLike):
        return os.fspath(value)
    if isinstance(value, int | float):
        return json.dumps(value)
    return str(value)


_READERS = {".csv": _csv_rows, ".jsonl": _json_rows}


def _recordings(folder: Path) -> Rows:
    """Yield a row for each recording below a folder, in the order of names; its id is its name there."""
    for parent, folders, files in os.walk(folder):
        folders.sort()
        by_stem: dict[str, dict[str, str]] = {}
        for name in sorted(files):
            file = Path(name)
            by_stem.setdefault(file.stem, {})[file.suffix.lower()] = name
        for stem, names in by_stem.items():
            yield from _recording_rows(folder, Path(parent, stem).relative_to(folder), names)


def _recording_rows(folder: Path, stem: Path, names: Mapping[str, str]) -> Rows:
    """Yield the rows of the files of one name below a folder, by suffix; of a text alone none."""
    labels = next((suffix for suffix in LABEL_SUFFIXES if suffix in names), None)
    sounds = [suffix for suffix in RECORDING_SUFFIXES if suffix in names]
    if not sounds and labels not in (None, ".txt"):
        place = Place(str(folder / stem.parent / names[labels]))
        yield InputError("there is no recording beside it; expected e.g. a .wav of that name", place)
    for suffix in sounds:
        audio = stem.parent / names[suffix]
        place = Place(str(folder / audio))
        if labels is None:
            message = "there are no words beside it; expected a .txt, .lab or .TextGrid of that name"
            yield InputError(message, place)
        else:
            column = "script" if labels == ".textgrid" else "transcript"
            words = str(stem.parent / names[labels])
            yield ManifestRow(place, {"id": stem.as_posix(), "audio": str(audio), column: words})
