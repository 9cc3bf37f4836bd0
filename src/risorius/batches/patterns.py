"""Names of outputs with columns in braces: `out/{language}/{id}.mp4`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import PurePosixPath

from ..errors import InputError, OutputError, Place
from ..machine.paths import is_utf8
from ..ports.formats import FileFormat, format_for
from .places import local_path

_COLUMN = re.compile(r"\{([^{}]*)\}")
_LONGEST_PART = 200  # bytes of a file's or a folder's name that a cell makes


@dataclass(frozen=True, slots=True)
class OutputPattern:
    """The pattern of an output's name; raises OutputError for one that names no column or no format."""

    text: str

    def __post_init__(self) -> None:
        if not is_utf8(self.text):
            raise OutputError("is not UTF-8; expected a name that can be written down", Place(self.text))
        fixed = _COLUMN.sub("", self.text)
        if "{" in fixed or "}" in fixed or "" in self.columns:
            raise OutputError("has a brace without a column; expected e.g. out/{id}.mp4", Place(self.text))
        if not self.columns:
            raise OutputError("names no column; expected e.g. out/{id}.mp4", Place(self.text))
        self.format  # noqa: B018 - raises

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns in it."""
        return tuple(name.strip() for name in _COLUMN.findall(self.text))

    @property
    def format(self) -> FileFormat:
        """The format that its suffix names."""
        return format_for(local_path(self.text))

    @property
    def fixed_folder(self) -> str:
        """The longest folder that all outputs have in common: the part before the first column."""
        before = self.text[: self.text.index("{")]
        return before[: before.rindex("/") + 1].rstrip("/") or "/" if "/" in before else "."

    def name(self, cells: Mapping[str, str]) -> str:
        """Return the name of a row's output; raises InputError for a cell that is missing or unfit."""

        def fill(match: re.Match[str]) -> str:
            column = match[1].strip()
            if not cells.get(column, "").strip():
                raise InputError(f"has no {column}, which the output name '{self.text}' needs")
            return checked_part(column, cells[column].strip())

        return _COLUMN.sub(fill, self.text)


def checked_part(column: str, value: str) -> str:
    """Return a cell that becomes part of a name, `/` among it; raises InputError unless it stays below."""
    shown = value if len(value) <= 60 else f"{value[:60]}…"
    if not value.isprintable() or "\\" in value or ":" in value:
        raise InputError(
            f"{column} {shown!r} cannot name a file; expected letters, digits, blanks, - _ . and /"
        )
    parts = value.split("/")
    if value.startswith("/") or ".." in PurePosixPath(value).parts:
        raise InputError(f"{column} '{shown}' leaves the folder of the outputs; expected a name below it")
    if any(part in ("", ".") for part in parts):
        raise InputError(f"{column} '{shown}' has an empty part; expected names between slashes")
    if any(len(part.encode()) > _LONGEST_PART for part in parts):
        raise InputError(
            f"{column} '{shown}' is too long; expected at most {_LONGEST_PART} bytes between slashes"
        )
    return value
