"""Reading of tables from TOML files: the package's own and a user's."""

from __future__ import annotations

import re
import tomllib
from importlib import resources
from pathlib import Path
from typing import TypeVar

from ..errors import InputError, Place
from .schema import Source, build

T = TypeVar("T")
DATA = resources.files(__package__) / "data"

_TOML_POSITION = re.compile(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)$", re.DOTALL)


def load(cls: type[T], name: str) -> T:
    """Return the package's table `name` (a path under `rules/data`, such as "timing.toml") as a `cls`."""
    return parse(cls, (DATA / name).read_text(encoding="utf-8"), name)


def load_folder(cls: type[T], folder: str) -> dict[str, T]:
    """Return all the package's tables in `folder`, by their path under `rules/data`, in order of name."""
    names = sorted(entry.name for entry in (DATA / folder).iterdir() if entry.name.endswith(".toml"))
    return {f"{folder}/{name}": load(cls, f"{folder}/{name}") for name in names}


def load_file(cls: type[T], path: Path) -> T:
    """Return a user's file as a `cls`; raise InputError if it cannot be read or does not fit `cls`."""
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", Place(str(path))) from None
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text; expected a TOML file", Place(str(path))) from None
    return parse(cls, text, str(path))


def parse(cls: type[T], text: str, name: str) -> T:
    """Return TOML text as a `cls`; raise InputError, with its place in file `name`, if it does not fit."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _toml_error(str(error), name) from None
    return build(cls, data, Source(name, text))


def _toml_error(message: str, name: str) -> InputError:
    position = _TOML_POSITION.match(message)
    if position is None:
        return InputError(f"not a TOML file: {message}", Place(name))
    line, column = (int(n) if n else None for n in position.group(2, 3))
    return InputError(f"not a TOML file: {position[1]}", Place(name, line, column))
