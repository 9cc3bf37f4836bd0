"""Declarations of settings: range or choices, option, the stage that reads it, and words.

A setting is a field of a frozen dataclass, made by `setting`. What a command line, a page and a manual need
to know of it is derived from the field (`rows`). Nothing here loads numpy: the command line's help waits for
it.
"""

from __future__ import annotations

import types
import typing
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import MISSING, dataclass, field, fields, is_dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cache
from numbers import Integral, Real
from pathlib import Path
from typing import Any

from ..core.names import Names, spelled, value_at
from ..errors import InputError, unknown
from ..reading.frozen import FrozenDict

_KEY = "setting"
_MANY = 1e9  # a limit from which on none is told


class Stage(StrEnum):
    """The stages of a performance that read settings."""

    VOICE = "voice"
    PLAN = "plan"
    COMBINE = "combine"
    FRAMES = "frames"
    HEAD = "head"
    SHAPE = "shape"
    SKIN = "skin"
    APPEARANCE = "appearance"
    PICTURE = "picture"
    OUTPUT = "output"


class Group(StrEnum):
    """Under which heading a setting stands in help, page and manual."""

    VOICE = "Voice"
    MANNER = "Manner"
    HEAD = "Head"
    MODELS = "Models"
    TIME = "Time and chance"
    PICTURE = "Picture"
    AVATAR = "Avatar"


class ValueKind(StrEnum):
    """The kind of a setting's value."""

    TEXT = "text"
    FILE = "file"
    NUMBER = "number"
    WHOLE = "whole number"
    SWITCH = "switch"
    SEVERAL = "names"
    AMOUNTS = "numbers by name"
    RATE = "frame rate"
    SIZE = "size"


_KINDS: Mapping[Any, ValueKind] = {
    str: ValueKind.TEXT,
    Path: ValueKind.FILE,
    float: ValueKind.NUMBER,
    int: ValueKind.WHOLE,
    bool: ValueKind.SWITCH,
    tuple[str, ...]: ValueKind.SEVERAL,
    Mapping[str, float]: ValueKind.AMOUNTS,
    Fraction: ValueKind.RATE,
    tuple[int, int]: ValueKind.SIZE,
}


_NUMBERS: Mapping[ValueKind, tuple[Callable[[str], float], str]] = {
    ValueKind.NUMBER: (float, "a number"),
    ValueKind.WHOLE: (int, "a whole number"),
}
_NAMED = (ValueKind.TEXT, ValueKind.SEVERAL, ValueKind.AMOUNTS)
_TYPES: Mapping[ValueKind, tuple[type, str]] = {
    ValueKind.TEXT: (str, "a text"),
    ValueKind.SWITCH: (bool, "True or False"),
    ValueKind.WHOLE: (Integral, "a whole number"),
    ValueKind.SEVERAL: (Collection, "a sequence of names"),
    ValueKind.AMOUNTS: (Mapping, "a mapping of names to numbers"),
    ValueKind.SIZE: (tuple, "width and height"),
}
SWITCHED = {"on": True, "off": False}


@dataclass(frozen=True, slots=True)
class Setting:
    """A setting's entry in the table, beside its type and its default.

    `label`: its name on a page. `flag`: its option, None if the command line has none; `metavar`: what stands
    for its value in help. `low`, `high`: its range, also of each of several amounts; `step` of a control.
    `names`: what it may be called, `what` errors call one of them; `find`, the path of a function, raises for
    a name that is not known, where files may be named as well. `usual`: what None comes to if a script
    is planned; `unset`: what None means, in words. `read`, a function or its path, makes a value of a text;
    `fills` names the settings that such a text gives if they are more than one. `on_page`: whether the studio
    shows it.
    """

    help: str
    stage: Stage
    group: Group
    label: str
    flag: str | None
    metavar: str
    low: float | None
    high: float | None
    step: float | None
    names: Names | None
    what: str
    find: str
    usual: object
    unset: str
    read: Callable[[str], Any] | str | None
    fills: tuple[str, ...]
    on_page: bool


def setting(
    stage: Stage,
    group: Group,
    label: str,
    default: Any,
    help: str,
    *,
    flag: str | None = "",
    metavar: str = "NAME",
    low: float | None = None,
    high: float | None = None,
    step: float | None = None,
    names: Iterable[str] | str | None = None,
    registry: str = "",
    what: str = "",
    find: str = "",
    usual: object = None,
    unset: str = "",
    read: Callable[[str], Any] | str | None = None,
    fills: tuple[str, ...] = (),
    on_page: bool = True,
) -> Any:
    """Return a dataclass field with its entry in the table (`Setting`).

    `names` is a sequence or a path; `registry` the path at which a sequence of names is described. In `help`
    {names}, {low} and {high} stand for the names and the range.
    """
    known = _names(names, registry)
    limits = (low, high, step)
    words = spelled(names or ()) if known is not None and known.known else ""
    entry = Setting(
        help.format(names=words, low=_number(low), high=_number(high)),
        stage,
        group,
        label,
        flag,
        metavar,
        *limits,
        known,
        what,
        find,
        usual,
        unset,
        read,
        fills,
        on_page,
    )
    if isinstance(default, dict):
        return field(default_factory=dict, metadata={_KEY: entry})
    return field(default=default, metadata={_KEY: entry})


def _names(names: Iterable[str] | str | None, registry: str) -> Names | None:
    if names is None:
        return None
    return Names(path=names) if isinstance(names, str) else Names(tuple(names), registry)


def _number(number: float | None) -> str:
    return "" if number is None else f"{number:g}"


@dataclass(frozen=True, slots=True)
class Row:
    """A row of the table: a setting's `name`, the field of the outermost dataclass it stands in (`owner`, its
    own name if it stands there itself), its kind, whether it may be None, and its entry.
    """

    name: str
    owner: str
    kind: ValueKind
    optional: bool
    default: Any
    entry: Setting

    @property
    def flag(self) -> str | None:
        """Its option on the command line, with dashes."""
        flag = self.entry.flag
        return f"--{self.name.replace('_', '-')}" if flag == "" else flag

    @property
    def called(self) -> str:
        """Its name in errors, which fits its option as well as its field."""
        return self.entry.what or self.name.replace("_", " ")

    @property
    def _expected(self) -> str:
        low, high = self.entry.low, self.entry.high
        if low is None or high is None:
            return ""
        return f"; expected {low:g} to {high:g}" if high < _MANY else f"; expected {low:g} or more"

    @property
    def usual(self) -> Any:
        """Its value if nobody chooses it."""
        return self.entry.usual if self.default is None else self.default

    @property
    def is_flag(self) -> bool:
        """Whether the option has no value, and sets the opposite of the default."""
        return self.kind is ValueKind.SWITCH and bool(self.entry.flag)

    @property
    def several(self) -> bool:
        """Whether its option may be given several times, each time with one of its values."""
        return self.kind is ValueKind.AMOUNTS or (self.kind is ValueKind.SEVERAL and self.entry.read is None)

    def read(self, text: str) -> Any:
        """Return the value that a text stands for, one of several if it has several.

        Raises InputError if the text does not fit.
        """
        read = self.entry.read
        if read is not None:
            return value_at(read)(text) if isinstance(read, str) else read(text)
        if self.kind in _NUMBERS:
            make, what = _NUMBERS[self.kind]
            try:
                return make(text)
            except ValueError:
                raise InputError(f"{self.called} '{text}' is not {what}{self._expected}") from None
        if self.kind is ValueKind.SWITCH:
            if text not in SWITCHED:
                raise InputError(unknown(self.called, text, SWITCHED))
            return SWITCHED[text]
        return Path(text) if self.kind is ValueKind.FILE else text

    def text(self, value: Any) -> str:
        """Return a value as a text that `read` takes; for None its meaning, in words."""
        if value is None:
            return self.entry.unset
        if self.kind is ValueKind.SWITCH:
            return next(word for word, meaning in SWITCHED.items() if meaning is value)
        if self.kind is ValueKind.SIZE:
            return "x".join(map(str, value))
        if self.kind is ValueKind.SEVERAL:
            return ",".join(value)
        if self.kind is ValueKind.AMOUNTS:
            return ",".join(f"{name}:{amount:g}" for name, amount in value.items())
        return f"{value:g}" if self.kind is ValueKind.NUMBER else str(value)


@cache
def rows(table: type) -> Mapping[str, Row]:
    """Return the settings of a dataclass by name, those of dataclasses in it among them, in their order."""
    hints = typing.get_type_hints(table)
    table_rows: dict[str, Row] = {}
    for f in fields(table):
        if is_dataclass(hints[f.name]):
            inner = rows(hints[f.name]).values()
            table_rows |= {r.name: Row(r.name, f.name, r.kind, r.optional, r.default, r.entry) for r in inner}
        else:
            default = FrozenDict() if f.default is MISSING else f.default
            kind, optional = _kind(hints[f.name])
            table_rows[f.name] = Row(f.name, f.name, kind, optional, default, f.metadata[_KEY])
    return table_rows


def _kind(hint: Any) -> tuple[ValueKind, bool]:
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        (inner,) = (part for part in typing.get_args(hint) if part is not types.NoneType)
        return _KINDS[inner], True
    return _KINDS[hint], False


def later(name: str) -> None:
    """Accept any name: the readers of the setting look it up."""


def check(settings: Any, spec: str = "") -> None:
    """Raise InputError for the first field that is not of its kind, out of its range or none of its names.

    `spec` is the format in which numbers at fault are shown. Names that a registry knows are looked up unless
    they are the default, so that the registry is not imported for it.
    """
    table: type = type(settings)
    for row in rows(table).values():
        value = getattr(settings, row.owner)
        if row.owner == row.name and value is not None:
            _check_kind(row, value)
            _check_names(row, value)
            _check_range(row, value, spec)


def _check_kind(row: Row, value: Any) -> None:
    types, what = _TYPES.get(row.kind, (object, ""))
    fits = _FITS.get(row.kind)
    if not isinstance(value, types) or (fits is not None and not fits(value)):
        raise InputError(f"{row.name} = {_shown(value)} is not {what}")


def _are_texts(values: Any) -> bool:
    return not isinstance(values, str) and all(isinstance(value, str) for value in values)


_FITS: Mapping[ValueKind, Callable[[Any], bool]] = {
    ValueKind.SEVERAL: _are_texts,
    ValueKind.AMOUNTS: _are_texts,
    ValueKind.SIZE: lambda size: len(size) == 2,
}


def _check_names(row: Row, value: Any) -> None:
    names = row.entry.names
    if names is None or row.kind not in _NAMED or value == row.default:
        return
    find = value_at(row.entry.find) if row.entry.find else None
    for name in (value,) if row.kind is ValueKind.TEXT else value:
        if find is not None:
            find(name)
        elif name not in names.known and name not in (known := [choice.name for choice in names.choices()]):
            raise InputError(unknown(row.called, name, known))


def _check_range(row: Row, value: Any, spec: str) -> None:
    low, high = row.entry.low, row.entry.high
    if low is None or high is None:
        return
    for name, number in _numbers(row, value):
        if not issubclass(type(number), Real):
            raise InputError(f"{name} = {_shown(number)} is not a number; expected {low:g} to {high:g}")
        if not low <= number <= high:
            raise InputError(f"{name} = {_shown(number, spec)} is out of range; expected {low:g} to {high:g}")


def _shown(value: Any, spec: str = "") -> str:
    """Return a value as messages show it: Python writes no number of thousands of digits."""
    try:
        return format(value, spec) if isinstance(value, int | float) else repr(value)
    except (ValueError, OverflowError):
        return "a number of many digits"


def _numbers(row: Row, value: Any) -> Iterable[tuple[str, Any]]:
    """Return the numbers of a setting with their names in messages."""
    if row.kind is ValueKind.AMOUNTS:
        return [(f"{row.name} {name}", number) for name, number in value.items()]
    if row.kind is ValueKind.SIZE:
        return [(f"the {side} of {row.name}", n) for side, n in zip(("width", "height"), value, strict=True)]
    return [(row.name, value)]
