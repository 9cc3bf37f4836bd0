"""Reading of strict tables from TOML texts and files."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import TypeVar

from ..errors import InputError, Place
from .schema import Source, build

T = TypeVar("T")

_TOML_POSITION = re.compile(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)$", re.DOTALL)


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
