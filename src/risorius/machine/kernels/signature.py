"""The types of a kernel's arguments, as its decorator declares them.

A signature is a list like "u4[:], f8[:, 3], f8, Places, (f8, f8) -> i8": numbers by kind and bytes (`b1` is
bool), arrays in C order with the length of each axis or a colon for any, NamedTuples by their name, other
tuples in parentheses, and after an arrow the number that is returned, if any. Each field of a NamedTuple has
its type as `Annotated[..., "f8[:, 3]"]`. Lengths that are given are checked, and make code quicker.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, get_type_hints

import numpy as np

_TOKEN = re.compile(r"(\w+)(\[[:\d,]+\])?|([(),])")
_NUMBER = re.compile(r"[fiu][1248]|b1")


@dataclass(frozen=True, slots=True)
class Value:
    """A number, or an array of numbers of a type in numpy's short form; 0 is an axis of any length."""

    type: str
    shape: tuple[int, ...] = ()

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of the numbers."""
        return np.dtype(self.type)

    def __str__(self) -> str:
        return self.type + (f"[{', '.join(str(n or ':') for n in self.shape)}]" if self.shape else "")

    def takes(self, argument: Any) -> bool:
        """Whether an argument is of this type."""
        if not self.shape:
            return isinstance(argument, int | float | np.number | np.bool_)
        return (
            isinstance(argument, np.ndarray)
            and argument.dtype == self.dtype
            and argument.ndim == len(self.shape)
            and all(n in (0, m) for n, m in zip(self.shape, argument.shape, strict=True))
            and argument.flags.c_contiguous
            and argument.flags.aligned
        )


@dataclass(frozen=True, slots=True)
class Record:
    """A tuple of values; `make` is the NamedTuple that it is, or None."""

    make: type | None
    names: tuple[str, ...]
    parts: tuple[Value | Record, ...]

    @property
    def is_flat(self) -> bool:
        """Whether no part is a tuple."""
        return all(isinstance(part, Value) for part in self.parts)


@dataclass(frozen=True, slots=True)
class Signature:
    """The types of all arguments, and the number that is returned."""

    arguments: tuple[Value | Record, ...]
    result: Value | None

    @property
    def values(self) -> list[Value]:
        """The types of all values, those in tuples in their order."""
        return [value for argument in self.arguments for value in _values(argument)]

    @property
    def is_flat(self) -> bool:
        """Whether no argument is a tuple."""
        return all(isinstance(argument, Value) for argument in self.arguments)

    def flatten(self, arguments: Sequence[Any]) -> list[Any] | None:
        """Return arguments with those in tuples in place of tuples; None if tuples have other lengths."""
        flat: list[Any] = []
        fits = all(
            _flatten(kind, argument, flat) for kind, argument in zip(self.arguments, arguments, strict=True)
        )
        return flat if fits else None

    def names(self, arguments: Sequence[str]) -> list[str]:
        """Return what the values are called, if the arguments are called so."""
        pairs = zip(self.arguments, arguments, strict=True)
        return [name for kind, argument in pairs for name in _names(kind, argument)]


def parse(text: str, names: Mapping[str, Any]) -> Signature:
    """Read a signature; NamedTuples are found by their names. Raises TypeError for any other text."""
    arguments, _, result = text.partition("->")
    tokens = list(_tokens(arguments))
    kinds = _list(tokens, names)
    returned = _named(result.strip(), (), names) if result else None
    if tokens or isinstance(returned, Record):
        raise TypeError(f"'{text}' is not a signature of a kernel")
    return Signature(tuple(kinds), returned)


def _tokens(text: str) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Yield names and signs, each with the axes after it; blanks do not count."""
    position, packed = 0, text.replace(" ", "")
    while position < len(packed):
        match = _TOKEN.match(packed, position)
        if match is None:
            raise TypeError(f"'{text}' is not a signature of a kernel")
        position = match.end()
        name, axes, sign = match.groups()
        lengths = axes[1:-1].split(",") if axes else ()
        if not all(length == ":" or length.isdigit() for length in lengths):
            raise TypeError(f"'{text}' is not a signature of a kernel")
        yield sign or name, tuple(0 if length == ":" else int(length) for length in lengths)


def _list(tokens: list[tuple[str, tuple[int, ...]]], names: Mapping[str, Any]) -> list[Value | Record]:
    """Take types with commas between them."""
    kinds: list[Value | Record] = []
    while tokens:
        name, axes = tokens.pop(0)
        if name == "(":
            parts = tuple(_list(tokens, names))
            if not tokens or tokens.pop(0)[0] != ")":
                raise TypeError("a parenthesis in the signature of a kernel is not closed")
            kinds.append(Record(None, tuple(map(str, range(len(parts)))), parts))
        else:
            kinds.append(_named(name, axes, names))
        if not tokens or tokens[0][0] != ",":
            break
        tokens.pop(0)
    return kinds


def _named(name: str, axes: tuple[int, ...], names: Mapping[str, Any]) -> Value | Record:
    if _NUMBER.fullmatch(name):
        return Value(name, axes)
    make = names.get(name)
    if axes or not hasattr(make, "_fields"):
        raise TypeError(f"'{name}' is neither a number nor a NamedTuple that the kernel's file knows")
    return _record(make)


def _record(make: Any) -> Record:
    hints = get_type_hints(make, include_extras=True)
    return Record(make, make._fields, tuple(_field(make, name, hints[name]) for name in make._fields))


def _field(make: Any, name: str, hint: Any) -> Value | Record:
    if hasattr(hint, "_fields"):
        return _record(hint)
    for described in getattr(hint, "__metadata__", ()):
        return parse(described, {}).values[0]
    raise TypeError(f"{make.__name__}.{name} has no type for kernels, as in Annotated[Array, 'f8[::1]']")


def _values(kind: Value | Record) -> Iterator[Value]:
    if isinstance(kind, Value):
        yield kind
    else:
        for part in kind.parts:
            yield from _values(part)


def _names(kind: Value | Record, name: str) -> Iterator[str]:
    if isinstance(kind, Value):
        yield name
    else:
        for part, field in zip(kind.parts, kind.names, strict=True):
            yield from _names(part, f"{name}.{field}")


def _flatten(kind: Value | Record, argument: Any, flat: list[Any]) -> bool:
    if isinstance(kind, Value):
        flat.append(argument)
        return True
    if not isinstance(argument, tuple) or len(argument) != len(kind.parts):
        return False
    if kind.is_flat:
        flat += argument
        return True
    return all(_flatten(part, value, flat) for part, value in zip(kind.parts, argument, strict=True))
