"""Type hints of dataclasses for the strict reader (`schema`), and their names in its errors."""

from __future__ import annotations

import json
import math
import types
import typing
from array import array
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Any, Literal

from .source_text import Syntax

MOST_DIGITS = 40  # of a whole number
_SHOWN = 40  # characters of a value

if typing.TYPE_CHECKING:
    Numbers = array[float]
else:
    Numbers = array  # Python 3.11 cannot say of what
"""A long list of numbers."""


@dataclass(frozen=True, slots=True)
class Range:
    """The least and greatest value of a number, or of each number of a list."""

    low: float = -math.inf
    high: float = math.inf


@dataclass(frozen=True, slots=True)
class Then:
    """Marks a type hint: a value that fits the type is replaced by what `convert` returns for it.

    `convert` may raise a RisoriusError, or MisfitError to name a part of the value. `of`: the type that the
    value has before, if it is another one.
    """

    convert: Callable[[Any], object]
    of: Any = None


@dataclass(frozen=True, slots=True)
class ChooseType:
    """For tables of several kinds: `choose` returns the dataclass of one from its keys; raises as `Then`."""

    choose: Callable[[Mapping[str, Any]], type]


def shown(value: object, syntax: Syntax) -> str:
    """Return a value as it is written, or its type if that is long."""
    if isinstance(value, Mapping):
        return _name_of(dict, syntax)
    if isinstance(value, list | tuple):
        text = f"[{', '.join(shown(item, syntax) for item in value[:_SHOWN])}]"
        return text if len(text) <= _SHOWN else f"a list of {len(value)}"
    if isinstance(value, int) and abs(value) >= 10**MOST_DIGITS:
        return f"a number of more than {MOST_DIGITS} digits"
    written = isinstance(value, str | bool | int | types.NoneType)
    text = json.dumps(value, ensure_ascii=False) if written else str(value)
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"


_NAMES: Mapping[Any, str] = {
    str: "a text", bool: "true or false", int: "a whole number", float: "a number", tuple: "a list",
    array: "a list of numbers", object: "any value",
}  # fmt: skip


def describe(hint: Any, syntax: Syntax) -> str:
    """Return the values that a type takes, in words."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        limits = [rule for rule in arguments[1:] if isinstance(rule, Range)]
        return " ".join((describe(arguments[0], syntax), *map(_bounds, limits)))
    if origin in (types.UnionType, typing.Union):
        # In an order of their own: `typing` may give that of an equal union written elsewhere.
        kinds = {describe(kind, syntax) for kind in arguments if kind is not types.NoneType}
        return " or ".join(sorted(kinds))
    if origin is Literal:
        return "one of " + ", ".join(map(str, arguments))
    if isinstance(hint, type) and issubclass(hint, StrEnum):
        return "one of " + ", ".join(hint)
    if origin is tuple:
        count = "" if arguments[-1] is Ellipsis else f" of {len(arguments)}"
        same = len({*arguments, Ellipsis}) == 2
        return f"a list{count}" + (f", each {describe(arguments[0], syntax)}" if same else "")
    return _name_of(origin or hint, syntax)


def _bounds(limits: Range) -> str:
    if math.isinf(limits.high):
        return f"of at least {limits.low:g}"
    return f"from {limits.low:g} to {limits.high:g}"


def _name_of(kind: Any, syntax: Syntax) -> str:
    return _NAMES.get(kind, "a table" if syntax is Syntax.TOML else "an object")
