"""Flat dataclasses as JSON objects: one key per field, checked against the field's type."""

from __future__ import annotations

import types
from collections.abc import Callable
from dataclasses import MISSING, Field, fields
from enum import StrEnum
from functools import cache
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from ..errors import unknown
from .node import Node

T = TypeVar("T")
Reader = Callable[[Node], object]


def to_record(item: Any) -> dict[str, Any]:
    """Return a dataclass of texts, numbers and flags as an object; what has its default is left out."""
    return {f.name: getattr(item, f.name) for f in fields(item) if getattr(item, f.name) != _default(f)}


def from_record(kind: Callable[..., T], node: Node) -> T:
    """Return the dataclass that an object describes.

    Raises InputError, with the place, for an unknown or missing key and a value of another type.
    """
    readers, required = _schema(kind)
    return kind(**{name: readers[name](entry) for name, entry in node.entries(readers, required).items()})


@cache
def _schema(kind: Any) -> tuple[dict[str, Reader], tuple[str, ...]]:
    hints = get_type_hints(kind)
    readers = {f.name: _reader(hints[f.name]) for f in fields(kind)}
    return readers, tuple(f.name for f in fields(kind) if _default(f) is MISSING)


def _default(f: Field[Any]) -> object:
    return f.default


def _reader(hint: Any) -> Reader:
    if get_origin(hint) in (Union, types.UnionType):
        (inner,) = (_reader(arg) for arg in get_args(hint) if arg is not type(None))
        return lambda node: None if node.value is None else inner(node)
    if issubclass(hint, StrEnum):
        return lambda node: _choice(hint, node)
    return {str: Node.text, bool: Node.flag, int: Node.integer, float: Node.number}[hint]


def _choice(hint: type[StrEnum], node: Node) -> StrEnum:
    try:
        return hint(node.text())
    except ValueError:
        raise node.fault(unknown("value", node.text(), list(hint))) from None
