"""Strict reading of the face's own tables (TOML under `face/data`)."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from importlib import resources
from typing import Any, TypeVar, cast

from ..errors import InputError, Place, unknown

T = TypeVar("T")


def read_table(name: str) -> dict[str, Any]:
    """Return the package's table `name`, such as "wrinkles.toml", as it stands."""
    return parse_table((resources.files(__package__) / "data" / name).read_text(encoding="utf-8"), name)


def parse_table(text: str, name: str) -> dict[str, Any]:
    """Return TOML text as tables by name; raise InputError with the file's `name` where it is none."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"not a TOML file: {error}", Place(name)) from None


def build(cls: type[T], values: Mapping[str, Any], what: str) -> T:
    """Return a dataclass from a table that has exactly its fields; lists become tuples.

    Raises InputError, naming `what`, for a key that is unknown or missing, and for a value of the wrong kind.
    """
    assert is_dataclass(cls)
    known = [f.name for f in fields(cls)]
    for key in values:
        if key not in known:
            raise InputError(f"{what}: {unknown('key', key, known)}")
    for key in known:
        if key not in values:
            raise InputError(f"{what}: '{key}' is missing; expected {', '.join(known)}")
    return cast(T, cls(**{key: _frozen(value, f"{what}: '{key}'") for key, value in values.items()}))


def _frozen(value: Any, what: str) -> Any:
    if isinstance(value, list):
        return tuple(_frozen(v, what) for v in value)
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise InputError(f"{what} is {value!r}; expected a number, a text or a list of numbers")
    return value
