"""Reading of strict tables from TOML texts and files, and writing of plain ones."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeVar

from ..errors import InputError, Place
from .schema import Source, build

T = TypeVar("T")

_TOML_POSITION = re.compile(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)$", re.DOTALL)


def load_file(cls: type[T], path: Path) -> T:
    """Return a user's file as a `cls`; raise InputError if it cannot be read or does not fit `cls`."""
    return parse(cls, read_text(path), str(path))


def load_rows(cls: type[T], path: Path) -> dict[str, T]:
    """Return a user's file whose tables are all a `cls`, by their names; raise InputError as `load_file`."""
    return parse_rows(cls, read_text(path), str(path))


def parse_rows(cls: type[T], text: str, name: str) -> dict[str, T]:
    """Return TOML text whose tables are all a `cls`, by their names; raise InputError as `parse`."""
    source = Source(name, text)
    rows = {}
    for key, entry in read_tables(text, name).items():
        if not isinstance(entry, dict):
            raise source.error((key,), f"{key} = {entry!r} cannot be used; expected a table")
        rows[key] = build(cls, entry, source, (key,))
    return rows


def read_text(path: Path) -> str:
    """Return a file's text; raise InputError, with its name, if it cannot be read or is not UTF-8."""
    try:
        return path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", Place(str(path))) from None
    except UnicodeDecodeError:
        raise InputError("is not UTF-8 text; expected a TOML file", Place(str(path))) from None


def parse(cls: type[T], text: str, name: str) -> T:
    """Return TOML text as a `cls`; raise InputError, with its place in file `name`, if it does not fit."""
    return build(cls, read_tables(text, name), Source(name, text))


def read_tables(text: str, name: str) -> dict[str, Any]:
    """Return what TOML text says; raise InputError, with its place in file `name`, if it is none."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _toml_error(str(error), name) from None


def _toml_error(message: str, name: str) -> InputError:
    position = _TOML_POSITION.match(message)
    if position is None:
        return InputError(f"not a TOML file: {message}", Place(name))
    line, column = (int(n) if n else None for n in position.group(2, 3))
    return InputError(f"not a TOML file: {position[1]}", Place(name, line, column))


_BARE = re.compile(r"[A-Za-z0-9_-]+")


def written(tables: Mapping[str, Any]) -> str:
    """Return TOML text that says `tables`: texts, numbers, flags, lists of these, and tables of all this."""
    return "\n".join(_lines(tables, ())).strip() + "\n"


def _lines(table: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    inner = {key: value for key, value in table.items() if isinstance(value, Mapping)}
    if path and (len(inner) < len(table) or not table):
        yield f"[{'.'.join(map(_key, path))}]"
    yield from (f"{_key(key)} = {_value(value)}" for key, value in table.items() if key not in inner)
    for key, value in inner.items():
        yield ""
        yield from _lines(value, (*path, key))


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _value(key)


def _value(value: object) -> str:
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    # JSON escapes a text as TOML does, but for one control character.
    return json.dumps(value, ensure_ascii=False, allow_nan=False).replace("\x7f", "\\u007f")
