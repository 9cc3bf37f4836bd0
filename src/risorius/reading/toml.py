"""Reading of strict tables from TOML texts and files, and writing of plain ones."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator, Mapping
from importlib import resources
from pathlib import Path
from typing import Any, TypeVar

from ..errors import InputError, Place
from .depth import MAX_DEPTH, TOO_DEEP, is_too_deep
from .schema import build
from .source_text import SourceText, Syntax, read_file

T = TypeVar("T")
MAX_BYTES = 4_000_000
# A name or a string, and what stands in a text of TOML, each piece read once: a string of several lines, a
# comment, a key (or values with dots between them), anything else. Strings need not end.
_NAME = r"""(?>[\w-]++|"(?:\\.|[^"\\\n])*+"?|'[^'\n]*+'?)"""
_PART = re.compile(_NAME, re.DOTALL)
_PIECE = re.compile(
    r'"""(?:\\.|[^\\])*?(?:"""|\Z)'
    r"|'''.*?(?:'''|\Z)"
    r"|#[^\n]*+"
    rf"|(?P<key>{_NAME}(?:[ \t]*+\.[ \t]*+{_NAME})*+)|.",
    re.DOTALL,
)
_TOML_POSITION = re.compile(r"(?:line (\d{1,9}), column (\d{1,9})|end of document)\)")


def load_file(cls: type[T], path: Path) -> T:
    """Return a user's file as a `cls`; raise InputError if it cannot be read or does not fit `cls`."""
    return parse(cls, read_text(path), str(path))


def load_rows(cls: type[T], path: Path) -> dict[str, T]:
    """Return a user's file whose tables are all a `cls`, by their names; raise InputError as `load_file`."""
    return parse_rows(cls, read_text(path), str(path))


def parse_rows(cls: type[T], text: str, name: str) -> dict[str, T]:
    """Return TOML text whose tables are all a `cls`, by their names; raise InputError as `parse`."""
    return build(dict[str, cls], read_tables(text, name), SourceText(name, text))  # type: ignore[valid-type]


def read_text(path: Path) -> str:
    """Return a TOML file's text; raise InputError, with its name, if it is not readable or too large."""
    return read_file(path, MAX_BYTES, Syntax.TOML)


def package_text(package: str, name: str) -> str:
    """Return the text of a table `name` in a package's folder `data`."""
    return (resources.files(package) / "data" / name).read_text(encoding="utf-8")


def parse(cls: type[T], text: str, name: str) -> T:
    """Return TOML text as a `cls`; raise InputError, with its place in file `name`, if it does not fit."""
    return build(cls, read_tables(text, name), SourceText(name, text))


def read_tables(text: str, name: str) -> dict[str, Any]:
    """Return the data of a TOML text; raise InputError, with its place in file `name`, if it is not TOML."""
    _check_keys(text, name)
    try:
        tables = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise _toml_error(str(error), name) from None
    except RecursionError:
        raise InputError(TOO_DEEP, Place(name)) from None
    except ValueError:
        # The only other fault: digits beyond what Python turns into an integer.
        raise InputError("holds a number with too many digits; expected fewer", Place(name)) from None
    for key, value in tables.items():
        if is_too_deep({key: value}):
            raise SourceText(name, text).error((key,), TOO_DEEP)
    return tables


def _check_keys(text: str, name: str) -> None:
    """Raise InputError for a key of more parts than tables may be nested: it takes Python quadratic time."""
    if all(line.count(".") < MAX_DEPTH for line in text.split("\n")):
        return
    for piece in _PIECE.finditer(text):
        key, at = piece["key"], piece.start()
        if key is not None and key.count(".") >= MAX_DEPTH and len(_PART.findall(key)) > MAX_DEPTH:
            place = Place(name, text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at))
            raise InputError(TOO_DEEP, place)


def _toml_error(message: str, name: str) -> InputError:
    fault, _, place = message.rpartition(" (at ")
    position = _TOML_POSITION.fullmatch(place)
    if position is None:
        return InputError(f"is not a TOML file: {message}", Place(name))
    line, column = (int(n) if n else None for n in position.groups())
    return InputError(f"is not a TOML file: {fault}", Place(name, line, column))


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
