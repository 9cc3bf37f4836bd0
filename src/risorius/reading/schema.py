"""Strict reading of TOML and JSON into frozen dataclasses: the dataclass is the schema.

A key that the dataclass does not have, one that is missing, or a value of another type or out of range is an
InputError that names file, line, column and key. Understood types: str, bool, int, float, Literal, enums of
strings, `tuple[T, ...]`, `tuple[A, B]`, `Numbers` (long lists of them), `Mapping[str, T]` (free keys, or the
keys of a Literal), dataclasses, `T | None`, `A | B` for plain types, `object` (anything), and these with
`Annotated`: `Range(low, high)`, `Then(function)` and `ChooseType(function)`. A field is read from the key of
its own name, or from `field(metadata={"key": …})`. Errors of dataclasses and functions get their place.
"""

from __future__ import annotations

import dataclasses
import math
import types
import typing
from array import array
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from enum import StrEnum
from functools import cache
from typing import Annotated, Any, Literal, TypeVar

from ..errors import InputError, RisoriusError, unknown
from .frozen import FrozenDict
from .hints import MOST_DIGITS, ChooseType, Range, Then, describe, shown
from .positions import KeyPath
from .source_text import SourceText, Syntax

T = TypeVar("T")
Converter = Callable[[object], object]
"""Converts a parsed value to a type; raises MisfitError."""
_LONGEST_KEY = 60  # characters of a key that are shown


class MisfitError(Exception):
    """A fault of a value, or of its part at `path`; `build` makes it a RisoriusError.

    `message` is a text, or a function that makes it of the value's dotted path and the file's syntax.
    """

    def __init__(
        self,
        message: str | Callable[[str, Syntax], str],
        *path: str | int,
        kind: type[RisoriusError] = InputError,
    ) -> None:
        super().__init__(message, path)
        self.message, self.path, self.kind = message, path, kind

    def error(self, source: SourceText, path: KeyPath) -> RisoriusError:
        """Return the error to raise for a value that stands at `path`."""
        path = (*path, *self.path)
        text = self.message if isinstance(self.message, str) else self.message(dotted(path), source.syntax)
        return source.error(path, text, self.kind)


class WrongTypeError(MisfitError):
    """A value is of another type."""


def build(cls: type[T], data: object, source: SourceText, path: KeyPath = ()) -> T:
    """Return the `cls` that `data`, which stands at `path` of a text, describes.

    Raises InputError, or what a dataclass or a function raises, with its place.
    """
    try:
        return typing.cast(T, converter(cls)(data))
    except MisfitError as misfit:
        raise misfit.error(source, path) from None


@contextmanager
def placed(source: SourceText, path: KeyPath = ()) -> Iterator[None]:
    """Give errors of the block the place of the value at `path`, or of the part of it that they name."""
    try:
        yield
    except MisfitError as misfit:
        raise misfit.error(source, path) from None
    except RisoriusError as error:
        raise error if error.place is not None else source.error(path, error.message, type(error)) from None


@contextmanager
def within(*path: str | int) -> Iterator[None]:
    """Let errors of the block name a part of the value: the one at `path`."""
    try:
        yield
    except MisfitError as misfit:
        misfit.path = (*path, *misfit.path)
        raise
    except RisoriusError as error:
        raise (
            error if error.place is not None else MisfitError(error.message, *path, kind=type(error))
        ) from None


def dotted(path: KeyPath) -> str:
    """Return a path as `rule[1].size`."""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part[:_LONGEST_KEY]}" for part in path)
    return text.removeprefix(".")


def converter(hint: Any) -> Converter:
    """Return the converter for values of a type; made once for each type."""
    return _made(hint)


@cache
def _made(hint: Any) -> Converter:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Annotated:
        return _annotated(arguments[0], arguments[1:])
    if origin in (types.UnionType, typing.Union):
        return _union(hint, arguments)
    if dataclasses.is_dataclass(hint):
        return _table(typing.cast(type, hint))
    if origin in (Mapping, dict):
        return _mapping(hint, *arguments)
    if origin is tuple:
        return _tuple(hint, arguments)
    if origin is Literal or (isinstance(hint, type) and issubclass(hint, StrEnum)):
        return _one_of(hint)
    return _PLAIN[origin or hint]


def _annotated(hint: Any, rules: tuple[Any, ...]) -> Converter:
    first = rules[0]
    if isinstance(first, ChooseType):
        convert = _chosen(hint, first)
    else:
        convert = converter(first.of if isinstance(first, Then) and first.of else hint)
    for rule in rules:
        if isinstance(rule, Range):
            convert = _ranged(hint, convert, rule)
        elif isinstance(rule, Then):
            convert = _continued(convert, rule.convert)
    return convert


def _ranged(hint: Any, convert: Converter, limits: Range) -> Converter:
    low, high = limits.low, limits.high

    def read(value: object) -> object:
        try:
            number: Any = convert(value)
        except WrongTypeError as wrong:
            raise wrong if wrong.path else _wrong(value, Annotated[hint, limits]) from None
        if type(number) is not tuple:
            if low <= number <= high:
                return number
            raise _out_of_range(value, Annotated[hint, limits])
        for index, item in enumerate(number):
            if not low <= item <= high:
                raise _out_of_range(item, Annotated[float, limits], index)
        return number

    return read


def _out_of_range(value: object, hint: Any, *path: int) -> MisfitError:
    def tell(at: str, syntax: Syntax) -> str:
        return f"{at} = {shown(value, syntax)} is out of range; expected {describe(hint, syntax)}"

    return MisfitError(tell, *path)


def _continued(convert: Converter, then: Callable[[Any], object]) -> Converter:
    def read(value: object) -> object:
        converted = convert(value)
        try:
            return then(converted)
        except RisoriusError as error:
            raise _refused(error) from None

    return read


def _refused(error: RisoriusError) -> Exception:
    """Return the error to raise for one of a dataclass or a function: the same if it has a place."""
    return error if error.place is not None else MisfitError(error.message, kind=type(error))


def _chosen(hint: Any, choice: ChooseType) -> Converter:
    def read(value: object) -> object:
        if not isinstance(value, Mapping):
            raise _wrong(value, hint)
        try:
            kind = choice.choose(value)
        except RisoriusError as error:
            raise _refused(error) from None
        return converter(kind)(value)

    return read


def _union(hint: Any, arguments: tuple[Any, ...]) -> Converter:
    converters = [converter(argument) for argument in arguments if argument is not types.NoneType]
    optional = len(converters) < len(arguments)

    def read(value: object) -> object:
        if value is None and optional:
            return None
        if len(converters) == 1:
            return converters[0](value)
        for convert in converters:
            try:
                return convert(value)
            except MisfitError:
                continue
        raise _wrong(value, hint)

    return read


def _table(cls: type) -> Converter:
    hints = typing.get_type_hints(cls, include_extras=True)
    fields = {str(f.metadata.get("key", f.name)): f for f in dataclasses.fields(cls) if f.init}
    converters = {key: (f.name, converter(hints[f.name])) for key, f in fields.items()}
    missing, factory = dataclasses.MISSING, dataclasses.MISSING
    required = [key for key, f in fields.items() if f.default is missing and f.default_factory is factory]

    def read(value: object) -> object:
        if not isinstance(value, Mapping):
            raise _wrong(value, cls)
        if not value.keys() <= converters.keys():
            raise _unknown_key(next(key for key in value if key not in converters), fields)
        for key in required:
            if key not in value:
                raise _missing_key(key, hints[fields[key].name])
        values = {}
        for key, item in value.items():
            name, convert = converters[key]
            try:
                values[name] = convert(item)
            except MisfitError as misfit:
                misfit.path = (key, *misfit.path)
                raise
        try:
            return cls(**values)
        except RisoriusError as error:
            raise _refused(error) from None

    return read


def _unknown_key(key: str, keys: Iterable[str]) -> MisfitError:
    def tell(at: str, _syntax: Syntax) -> str:
        # The nearest is that of the key alone: what stands before it is alike in all.
        return unknown("key", key, keys).replace(f"'{key}'", f"'{at}'", 1)

    return MisfitError(tell, key)


def _missing_key(key: str, hint: Any) -> MisfitError:
    def tell(at: str, syntax: Syntax) -> str:
        name = f"{at}.{key}" if at else key
        return f"key '{name}' is missing; expected {describe(hint, syntax)}"

    return MisfitError(tell)


def _mapping(hint: Any, keys: Any, inner: Any) -> Converter:
    convert = converter(inner)
    literals = typing.get_args(keys) if typing.get_origin(keys) is Literal else None
    frozen = typing.get_origin(hint) is Mapping  # tables are shared by all runs

    def read(value: object) -> object:
        if not isinstance(value, Mapping):
            raise _wrong(value, hint)
        items = {}
        for key, item in value.items():
            if literals is not None and key not in literals:
                raise _unknown_key(key, literals)
            try:
                items[key] = convert(item)
            except MisfitError as misfit:
                misfit.path = (key, *misfit.path)
                raise
        return FrozenDict(items) if frozen else items

    return read


def _tuple(hint: Any, arguments: tuple[Any, ...]) -> Converter:
    endless = arguments[-1] is Ellipsis
    converters = [converter(argument) for argument in arguments if argument is not Ellipsis]

    def read(value: object) -> object:
        if not isinstance(value, list | tuple) or not (endless or len(value) == len(converters)):
            raise _wrong(value, hint)
        items = []
        for index, item in enumerate(value):
            try:
                items.append(converters[0 if endless else index](item))
            except MisfitError as misfit:
                misfit.path = (index, *misfit.path)
                raise
        return tuple(items)

    return read


def _one_of(hint: Any) -> Converter:
    allowed = {value: value for value in typing.get_args(hint)} or {str(member): member for member in hint}

    def read(value: object) -> object:
        # A flag is not a choice, although True == 1 in Python.
        if type(value) not in (str, int) or value not in allowed:
            raise _wrong(value, hint)
        return allowed[value]

    return read


def _number(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
        raise _wrong(value, float)
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if math.isinf(number):
        raise MisfitError(lambda at, _: f"{at} is too large; expected a number")
    return number


def _whole(value: object) -> object:
    if isinstance(value, bool) or not isinstance(value, int):
        raise _wrong(value, int)
    if abs(value) >= 10**MOST_DIGITS:
        raise MisfitError(lambda at, _: f"{at} is too large; expected at most {MOST_DIGITS} digits")
    return value


def _numbers(value: object) -> object:
    if not isinstance(value, list):
        raise _wrong(value, array)
    if set(map(type, value)) <= {float, int}:
        with suppress(OverflowError):
            numbers = array("d", value)
            if all(map(math.isfinite, numbers)):
                return numbers
    # One of them is not a number: this says which.
    return array("d", typing.cast(tuple[float, ...], converter(tuple[float, ...])(value)))


def _same(kind: type) -> Converter:
    def read(value: object) -> object:
        if not isinstance(value, kind):
            raise _wrong(value, kind)
        return value

    return read


_PLAIN: dict[Any, Converter] = {
    str: _same(str),
    bool: _same(bool),
    int: _whole,
    float: _number,
    object: lambda value: value,
    Any: lambda value: value,
    array: _numbers,
}


def _wrong(value: object, hint: Any) -> WrongTypeError:
    def tell(at: str, syntax: Syntax) -> str:
        fault = f"{at} = {shown(value, syntax)} cannot be used" if at else f"holds {shown(value, syntax)}"
        return f"{fault}; expected {describe(hint, syntax)}"

    return WrongTypeError(tell)
