"""Messages as JSON: the dataclasses of `wire`, and how answers and events are written."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar, cast

from ...reading.json_object import without_nulls
from ...reading.schema import converter
from .events import EVENTS

T = TypeVar("T")
_EVENT_NAMES = {cls: name for name, cls in EVENTS.items()}


def read_message(kind: type[T], data: Mapping[str, object]) -> T:
    """Return a dataclass of `wire` from JSON data; raises MisfitError for data that does not fit."""
    return cast(T, converter(kind)(without_nulls(data)))


def encoded(item: Any) -> Any:
    """Return a dataclass of `wire` as JSON data."""
    if is_dataclass(item):
        return {f.name: encoded(getattr(item, f.name)) for f in fields(item)}
    if isinstance(item, dict):
        return {key: encoded(value) for key, value in item.items()}
    if isinstance(item, tuple | list):
        return [encoded(value) for value in item]
    return item


def answer(number: int, item: Any) -> str:
    """Return the answer to a request."""
    return _text({"re": number, "ok": encoded(item)})


def refusal(number: int | None, message: str) -> str:
    """Return the answer to a request that cannot be followed."""
    return _text({"re": number, "error": message})


def event(item: Any) -> str:
    """Return an event as a message."""
    return _text({"event": _EVENT_NAMES[type(item)], **encoded(item)})


def _text(data: Any) -> str:
    return json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
