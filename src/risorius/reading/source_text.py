"""The text that data was read from: it says where in its file each value stands."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from ..errors import InputError, Place, RisoriusError
from .positions import KeyPath, json_position, toml_position


class Syntax(StrEnum):
    """The syntax of data in a text."""

    TOML = "TOML"
    JSON = "JSON"


@dataclass(frozen=True, slots=True)
class SourceText:
    """A file's name and text; without the text, errors name the file alone."""

    name: str
    text: str = ""
    syntax: Syntax = Syntax.TOML

    def error(self, path: KeyPath, message: str, kind: type[RisoriusError] = InputError) -> RisoriusError:
        """Return an error about the value at `path`."""
        return kind(message, self.place(path))

    def place(self, path: KeyPath) -> Place:
        """Return where the value at `path` stands: its key, its item, or the nearest above it."""
        position = json_position if self.syntax is Syntax.JSON else toml_position
        at = position(self.text, path) if path and self.text else None
        if at is None:
            return Place(self.name)
        line = self.text.count("\n", 0, at) + 1
        return Place(self.name, line, at - self.text.rfind("\n", 0, at))


def read_file(path: Path, largest: int, syntax: Syntax) -> str:
    """Return the text of a file of at most `largest` bytes.

    Raises InputError, with its name, if it cannot be read, is larger or is not UTF-8.
    """
    place = Place(str(path))
    try:
        with path.open("rb") as file:
            data = file.read(largest + 1)
    except (OSError, ValueError) as error:
        raise InputError(f"cannot be read: {getattr(error, 'strerror', None) or error}", place) from None
    if len(data) > largest:
        raise InputError(f"is larger than {largest // 1_000_000} MB; expected less", place)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"is not UTF-8 text (byte {error.start}); expected a {syntax} file", place) from None
