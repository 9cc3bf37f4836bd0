"""The settings that a page may choose, as messages: derived from the table of settings.

Settings that shape the performance are chosen with it (`choices_class`); settings of pictures and files are
chosen with an export (`export_class`). A message never holds the name of a file on the server.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field, make_dataclass
from typing import Annotated, Any

from ...reading.hints import Range
from ...settings import Settings
from ...settings.declare import Row, Stage, ValueKind, rows

EXPORTED = (Stage.PICTURE, Stage.OUTPUT)
LARGEST_WHOLE = 2**31  # numbers in a browser are floats
_TYPES: dict[ValueKind, Any] = {
    ValueKind.TEXT: str,
    ValueKind.SWITCH: bool,
    ValueKind.SEVERAL: tuple[str, ...],
    ValueKind.RATE: str,
    ValueKind.SIZE: str,
}
Fields = list[tuple[str, Any, Any] | tuple[str, Any]]


def chosen_rows() -> Iterator[Row]:
    """Yield the settings that a page chooses for a performance."""
    return (row for row in rows(Settings).values() if _on_page(row) and row.entry.stage not in EXPORTED)


def exported_rows() -> Iterator[Row]:
    """Yield the settings that a page chooses for an export."""
    return (row for row in rows(Settings).values() if _on_page(row) and row.entry.stage in EXPORTED)


def choices_class(module: str) -> type:
    """Return the class of a page's choices for a performance, as if defined in `module`."""
    texts: Fields = [
        ("profile_text", str | None, field(default=None)),
        ("rules_off", tuple[str, ...], field(default=())),
    ]
    doc = """The settings of a performance that a page may choose; null means the library's default.

    `rules_off`: rules that are switched off, by id or by the part of it before a dot. `profile_text`: a
    profile edited in the page (TOML); it takes precedence over `profile`.
    """
    return _dataclass("Choices", doc, module, [*map(_field, chosen_rows()), *texts])


def export_class(module: str, first_fields: Fields) -> type:
    """Return the class of a request to export: `first_fields`, then the settings of an export."""
    doc = """Write a take as files with these suffixes; answered by Job, then progress and exported events."""
    return _dataclass("Export", doc, module, [*first_fields, *map(_field, exported_rows())])


def on_wire(row: Row, value: Any) -> Any:
    """Return a setting's value as it is sent."""
    return row.text(value) if row.kind in (ValueKind.RATE, ValueKind.SIZE) else value


def _on_page(row: Row) -> bool:
    return row.entry.on_page and row.kind in (*_TYPES, ValueKind.NUMBER, ValueKind.WHOLE)


def _dataclass(name: str, doc: str, module: str, entries: Fields) -> type:
    cls = make_dataclass(name, entries, frozen=True, slots=True, namespace={"__doc__": doc})
    cls.__module__ = module
    return cls


def _field(row: Row) -> tuple[str, Any, Any]:
    kind = _TYPES.get(row.kind) or _number(row)
    hint = kind | None if row.optional and row.usual is None else kind
    return row.name, hint, field(default=on_wire(row, row.usual))


def _number(row: Row) -> Any:
    low, high = row.entry.low, row.entry.high
    if row.kind is ValueKind.WHOLE:
        return Annotated[int, Range(low or 0, min(high or LARGEST_WHOLE, LARGEST_WHOLE))]
    return float if low is None or high is None else Annotated[float, Range(low, high)]
