"""Strict reading of tables into frozen dataclasses: the dataclass is the schema.

A key that the dataclass does not have, one that is missing, or a value of another type or out of range is an
InputError that names the file, the line and the key. Understood types: str, bool, int, float, Literal, enums
of strings, `tuple[T, ...]`, `tuple[A, B]`, `Mapping[str, T]` (free keys), dataclasses, `T | None` (for keys
that may be left out) and `Annotated[T, Range(low, high)]`. A field is read from the key of its own name, or
from `field(metadata={"key": …})`. What a dataclass raises in `__post_init__` is given its place.
"""

from __future__ import annotations

import dataclasses
import math
import re
import types
import typing
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Any, Literal, TypeVar

from ..errors import InputError, Place, RisoriusError, unknown
from .frozen import FrozenDict

T = TypeVar("T")
KeyPath = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Range:
    """The least and greatest value of a number."""

    low: float = -math.inf
    high: float = math.inf


@dataclass(frozen=True, slots=True)
class Source:
    """A table's file name and text, to say where something stands."""

    name: str
    text: str = ""

    def error(self, path: KeyPath, message: str) -> InputError:
        """Return an error about the value at `path`."""
        return InputError(message, self.place(path))

    def place(self, path: KeyPath) -> Place:
        """Return where the value at `path` stands."""
        return Place(self.name, line_of(self.text, path))


def build(cls: type[T], data: Mapping[str, object], source: Source, path: KeyPath = ()) -> T:
    """Return the dataclass `cls` made from `data`; raise InputError where they do not agree."""
    hints = typing.get_type_hints(cls, include_extras=True)
    fields = {str(f.metadata.get("key", f.name)): f for f in dataclasses.fields(cls)}  # type: ignore[arg-type]
    for key in data:
        if key not in fields:
            raise source.error((*path, key), unknown("key", _dotted((*path, key)), _keys(path, fields)))
    values: dict[str, object] = {}
    for key, f in fields.items():
        if key in data:
            values[f.name] = _convert(hints[f.name], data[key], source, (*path, key))
        elif f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING:
            expected = _describe(hints[f.name])
            raise source.error(path, f"key '{_dotted((*path, key))}' is missing; expected {expected}")
    try:
        return cls(**values)
    except RisoriusError as error:
        raise error.at(source.place(path)) from None


def _keys(path: KeyPath, fields: Mapping[str, object]) -> list[str]:
    return [_dotted((*path, key)) for key in fields]


def _dotted(path: KeyPath) -> str:
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.removeprefix(".")


def _convert(hint: Any, value: object, source: Source, path: KeyPath) -> object:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        return _in_range(_convert(arguments[0], value, source, path), arguments[1], source, path)
    if origin in (types.UnionType, typing.Union):
        (inner,) = (a for a in arguments if a is not types.NoneType)
        return _convert(inner, value, source, path)
    if dataclasses.is_dataclass(hint) and isinstance(value, Mapping):
        return build(typing.cast(type, hint), value, source, path)
    convert = _CONTAINERS.get(origin)
    converted = convert(arguments, value, source, path) if convert else _scalar(hint, value)
    if converted is None:
        found = f"{_dotted(path)} = {_shown(value)}"
        raise source.error(path, f"{found} cannot be used; expected {_describe(hint)}")
    return converted


def _scalar(hint: Any, value: object) -> object:
    """Return `value` as the plain type `hint`, None if it is none."""
    if hint is float:
        number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        return float(typing.cast(float, value)) if number else None
    if hint is int:
        return value if isinstance(value, int) and not isinstance(value, bool) else None
    if typing.get_origin(hint) is Literal:
        return value if value in typing.get_args(hint) else None
    if issubclass(hint, StrEnum):
        return hint(value) if value in tuple(hint) else None
    return value if isinstance(value, hint) else None


def _mapping(arguments: tuple[Any, ...], value: object, source: Source, path: KeyPath) -> object:
    if not isinstance(value, Mapping):
        return None
    return FrozenDict({key: _convert(arguments[1], v, source, (*path, key)) for key, v in value.items()})


def _tuple(arguments: tuple[Any, ...], value: object, source: Source, path: KeyPath) -> object:
    if not isinstance(value, list | tuple):
        return None
    hints = (arguments[0],) * len(value) if arguments[-1] is Ellipsis else arguments
    if len(hints) != len(value):
        return None
    pairs = zip(hints, value, strict=True)
    return tuple(_convert(hint, item, source, (*path, i)) for i, (hint, item) in enumerate(pairs))


_CONTAINERS: dict[Any, Callable[[tuple[Any, ...], object, Source, KeyPath], object]] = {
    Mapping: _mapping,
    dict: _mapping,
    tuple: _tuple,
}


def _in_range(value: object, limits: Range, source: Source, path: KeyPath) -> object:
    for number in value if isinstance(value, tuple) else (value,):
        if not limits.low <= typing.cast(float, number) <= limits.high:
            expected = _describe(Annotated[float, limits])
            raise source.error(path, f"{_dotted(path)} = {number} is out of range; expected {expected}")
    return value


_NAMES = {
    str: "a text", bool: "true or false", int: "a whole number", float: "a number",
    tuple: "a list", Mapping: "a table", dict: "a table",
}  # fmt: skip


def _describe(hint: Any) -> str:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        low, high = arguments[1].low, arguments[1].high
        bounds = f"at least {low:g}" if math.isinf(high) else f"from {low:g} to {high:g}"
        return f"{_describe(arguments[0])} {bounds}"
    if origin is Literal:
        return "one of " + ", ".join(map(str, arguments))
    if origin in (types.UnionType, typing.Union):
        return _describe(arguments[0])
    if isinstance(hint, type) and issubclass(hint, StrEnum):
        return "one of " + ", ".join(hint)
    if origin is tuple and arguments[-1] is not Ellipsis:
        return f"a list of {len(arguments)}"
    if origin is tuple:
        return f"a list, each {_describe(arguments[0])}"
    return _NAMES.get(origin or hint, "a table")


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:39] + "…"


_HEADER = re.compile(r"\s*(\[\[?)\s*([^\]]+?)\s*\]")
_KEY = re.compile(r"""\s*((?:"[^"]*"|'[^']*'|[\w-]+)(?:\s*\.\s*(?:"[^"]*"|'[^']*'|[\w-]+))*)\s*=""")
_PART = re.compile(r""""([^"]*)"|'([^']*)'|([\w-]+)""")


def line_of(text: str, path: KeyPath) -> int | None:
    """Return the line, from 1, of the TOML `text` where `path` or the nearest table above it stands."""
    best: tuple[int, int | None] = (0, None)
    table: KeyPath = ()
    counts: dict[KeyPath, int] = {}
    for number, line in enumerate(text.split("\n"), 1):
        here: KeyPath = ()
        if header := _HEADER.match(line):
            table = _parts(header[2])
            if header[1] == "[[":
                counts[table] = counts.get(table, -1) + 1
                table = (*table, counts[table])
            here = table
        elif key := _KEY.match(line):
            here = (*table, *_parts(key[1]))
        if len(here) > best[0] and path[: len(here)] == here:
            best = (len(here), number)
    return best[1]


def _parts(dotted: str) -> KeyPath:
    return tuple(next(filter(None, m.groups()), "") for m in _PART.finditer(dotted))
