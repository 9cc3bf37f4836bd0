"""Numbers with a unit: what lies outside of a range is an error that names its line."""

import math
import typing
from dataclasses import make_dataclass

import pytest

from risorius.core import units
from risorius.errors import InputError
from risorius.reading.hints import Range
from risorius.reading.schema import build
from risorius.reading.source_text import SourceText

UNITS = {name: unit for name, unit in vars(units).items() if typing.get_origin(unit) is typing.Annotated}


def _read(unit: object, value: float) -> float:
    table = make_dataclass("Table", [("number", unit)])
    row: float = build(table, {"number": value}, SourceText("table.toml", f"number = {value}")).number
    return row


def _range(unit: object) -> Range:
    (limits,) = [part for part in typing.get_args(unit) if isinstance(part, Range)]
    return limits


@pytest.mark.parametrize("name", UNITS)
def test_numbers_outside_of_the_range_are_errors(name: str) -> None:
    limits = _range(UNITS[name])
    for value in (
        math.nextafter(limits.low, -math.inf),
        math.nextafter(limits.high, math.inf),
        limits.low - 1,
    ):
        with pytest.raises(InputError, match=r"^table\.toml:1:1: number = .* is out of range"):
            _read(UNITS[name], value)


@pytest.mark.parametrize("name", UNITS)
def test_both_ends_of_the_range_are_read(name: str) -> None:
    limits = _range(UNITS[name])
    assert [_read(UNITS[name], end) for end in (limits.low, limits.high)] == [limits.low, limits.high]
