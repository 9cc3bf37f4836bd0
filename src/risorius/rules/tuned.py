"""A speaker's numbers, each with its range, and files of profiles in which some are others."""

from __future__ import annotations

import dataclasses
import math
import typing
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ..errors import ParameterError, unknown
from ..reading.hints import Range
from ..reading.toml import written
from .profiles import Profile, profile, profile_from, profile_texts

# A speaker's rules have numbers of their own.
_RULES = ("rule", "delete")


@dataclass(frozen=True, slots=True)
class Number:
    """A number of a profile: its dotted key, value and range (null for an open end)."""

    key: str
    value: float
    low: float | None
    high: float | None


def numbers_of(item: Any, prefix: str = "") -> Iterator[Number]:
    """Yield all numbers of a profile (or a part), those of a tuple as `key.0`, of a mapping as `key.name`."""
    hints = typing.get_type_hints(type(item), include_extras=True)
    for f in dataclasses.fields(item):
        if f.name in _RULES:
            continue
        yield from _numbers(f"{prefix}{f.name}", getattr(item, f.name), hints[f.name])


def _numbers(key: str, value: Any, hint: Any) -> Iterator[Number]:
    limits = next((a for a in _inside(hint) if isinstance(a, Range)), Range())
    if dataclasses.is_dataclass(value):
        yield from numbers_of(value, f"{key}.")
    elif isinstance(value, Mapping):
        for name, number in value.items():
            yield from _numbers(f"{key}.{name}", number, hint)
    elif isinstance(value, tuple):
        for place, number in enumerate(value):
            yield from _numbers(f"{key}.{place}", number, hint)
    elif isinstance(value, float | int) and not isinstance(value, bool):
        ends = [None if math.isinf(end) else end for end in (limits.low, limits.high)]
        yield Number(key, float(value), *ends)


def _inside(hint: Any) -> Iterator[Any]:
    """Yield a type's arguments, all the way down."""
    yield hint
    for argument in (*getattr(hint, "__metadata__", ()), *typing.get_args(hint)):
        yield from _inside(argument)


def tuned_text(base: str, name: str, numbers: Mapping[str, float]) -> str:
    """Return the file (TOML) of a profile `name` that rests on `base`, with other numbers by dotted key.

    Raises ParameterError for an unknown profile or key, InputError for a number out of its range.
    """
    changed = nested(profile(base), numbers)
    head = {"name": name, "base": base, "description": f"Like {base}, tuned by hand.", "source": "by hand"}
    text = written({**head, **changed})
    profile_from(text, name, profile_texts())
    return text


def nested(under: Profile, numbers: Mapping[str, float]) -> dict[str, Any]:
    """Return numbers by dotted key as nested tables, laid out as the profile is.

    Raises ParameterError for an unknown key.
    """
    changed: dict[str, Any] = {}
    for key, value in numbers.items():
        try:
            _set(changed, under, key.split("."), value, key)
        except KeyError:
            known = (number.key for number in numbers_of(under))
            raise ParameterError(unknown("number of a profile", key, known)) from None
    return changed


def _set(table: dict[str, Any], item: Any, path: list[str], value: float, key: str) -> None:
    """Set a number in `table`, which is laid out as the dataclass `item`; KeyError if it has none."""
    first, rest = path[0], path[1:]
    current = getattr(item, first) if first in _numbered(item) else None
    if dataclasses.is_dataclass(current):
        if not rest:
            raise KeyError(key)
        _set(table.setdefault(first, {}), current, rest, value, key)
    elif isinstance(current, Mapping) and rest:
        table.setdefault(first, {})[".".join(rest)] = value
    elif isinstance(current, tuple) and rest:
        table[first] = _replaced(table.get(first, list(current)), rest, value, key)
    elif not rest and first in _numbered(item) and not isinstance(current, tuple | Mapping):
        table[first] = value
    else:
        raise KeyError(key)


def _numbered(item: Any) -> tuple[str, ...]:
    """Return the fields of a profile or a part that hold numbers, or may."""
    fields = (f.name for f in dataclasses.fields(item) if f.name not in _RULES)
    return tuple(name for name in fields if not isinstance(getattr(item, name), str))


def _replaced(items: list[float], path: list[str], value: float, key: str) -> list[float]:
    place = int(path[0]) if len(path) == 1 and path[0].isdigit() else len(items)
    if place >= len(items):
        raise KeyError(key)
    return [value if i == place else item for i, item in enumerate(items)]
