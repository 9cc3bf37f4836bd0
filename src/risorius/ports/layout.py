"""JSON laid out to be read and compared: one movement, phone or curve on a line, numbers exactly."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from typing import Any

# Lists of numbers longer than this get a line of their own.
_LONG = 32
_SURROGATE = re.compile("[\ud800-\udfff]")


def to_record(item: Any) -> dict[str, Any]:
    """Return a dataclass of texts, numbers and flags as an object, without fields at their defaults."""
    values = {f.name: (getattr(item, f.name), f.default) for f in fields(item)}
    return {name: value for name, (value, default) in values.items() if value != default}


def write_json(path: Path, document: dict[str, Any]) -> None:
    """Write a JSON document as UTF-8; floats as their shortest exact form.

    Raises ValueError for a number that is not finite.
    """
    with path.open("w", encoding="utf-8", newline="") as file:
        file.writelines(_pieces(document, ""))
        file.write("\n")


def _pieces(value: Any, indent: str) -> Iterator[str]:
    if not _spread(value):
        yield _compact(value)
        return
    inner = indent + "  "
    opening, closing = "{}" if isinstance(value, dict) else "[]"
    entries = value.items() if isinstance(value, dict) else ((None, item) for item in value)
    separator = "\n"
    yield opening
    for name, entry in entries:
        yield separator + inner + ("" if name is None else f"{_compact(name)}: ")
        yield from _pieces(entry, inner)
        separator = ",\n"
    yield f"\n{indent}{closing}"


def _spread(value: Any) -> bool:
    """Whether the parts of a value stand on lines of their own: lists of objects, and their holders."""
    if isinstance(value, list):
        return any(isinstance(item, dict) for item in value)
    if isinstance(value, dict):
        return any(_spread(entry) or _is_long(entry) for entry in value.values())
    return False


def _is_long(value: Any) -> bool:
    return isinstance(value, list) and len(value) > _LONG


def _compact(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False, allow_nan=False)
    # Halves of a character pair cannot be written as UTF-8.
    return _SURROGATE.sub(lambda half: f"\\u{ord(half[0]):04x}", text)
