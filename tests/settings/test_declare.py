"""Declarations of settings: what is derived from a field, and what a value may not be."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import pytest

from risorius.core.names import Choice, Names, spelled
from risorius.errors import InputError
from risorius.settings.declare import Group, Stage, ValueKind, check, rows, setting

_some = partial(setting, Stage.PLAN, Group.MODELS)


@dataclass(frozen=True)
class Inner:
    hue: str = _some("Hue", "red", "h", names=("red", "blue"), what="colour")
    glow: float | None = _some("Glow", None, "h", low=0.0, high=1.0, unset="its own", usual=0.5)

    def __post_init__(self) -> None:
        check(self, "g")


@dataclass(frozen=True)
class Outer:
    count: int = _some("Count", 3, "h", low=1, high=9)
    loud: bool = _some("Loud", True, "h", flag="--quiet")
    parts: tuple[str, ...] = _some("Parts", (), "h", names=("a", "b"))
    amounts: Mapping[str, float] = _some("Amounts", {}, "h", low=-1.0, high=1.0)
    side: tuple[int, int] = _some("Side", (2, 2), "h", low=1, high=4)
    file: Path | None = _some("File", None, "h", flag=None)  # noqa: RUF009 - it returns a field
    inner: Inner = field(default_factory=Inner)

    def __post_init__(self) -> None:
        check(self)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Inner(hue="bleu"), "unknown colour 'bleu'; did you mean 'blue'"),
        (lambda: Inner(glow=2.0), "glow = 2 is out of range; expected 0 to 1"),
        (lambda: Inner(glow=float("nan")), "glow = nan is out of range"),
        (lambda: Outer(count=10), "count = 10 is out of range; expected 1 to 9"),
        (lambda: Outer(parts=("a", "c")), "unknown parts 'c'; expected one of a, b"),
        (lambda: Outer(side=(2, 5)), "the height of side = 5 is out of range; expected 1 to 4"),
        (lambda: rows(Outer)["count"].read("three"), "count 'three' is not a whole number"),
        (lambda: rows(Outer)["glow"].read("much"), "glow 'much' is not a number"),
        (lambda: rows(Outer)["loud"].read("yes"), "unknown loud 'yes'; expected one of on, off"),
    ],
)
def test_a_value_that_a_setting_cannot_have_is_named(make, message):
    with pytest.raises(InputError, match=message):
        make()


def test_rows_are_the_fields_in_order_those_of_inner_tables_among_them():
    table = rows(Outer)
    assert list(table) == ["count", "loud", "parts", "amounts", "side", "file", "hue", "glow"]
    assert [row.owner for row in table.values()] == [*list(table)[:6], "inner", "inner"]
    own = [
        ValueKind.WHOLE,
        ValueKind.SWITCH,
        ValueKind.SEVERAL,
        ValueKind.AMOUNTS,
        ValueKind.SIZE,
        ValueKind.FILE,
    ]
    assert [row.kind for row in table.values()] == [*own, ValueKind.TEXT, ValueKind.NUMBER]
    assert [row.name for row in table.values() if row.optional] == ["file", "glow"]


def test_options_defaults_and_what_stands_for_none():
    table = rows(Outer)
    assert (table["count"].flag, table["loud"].flag, table["file"].flag) == ("--count", "--quiet", None)
    assert (table["glow"].default, table["glow"].usual, table["count"].usual) == (None, 0.5, 3)
    assert [row.name for row in table.values() if row.several] == ["parts", "amounts"]


@pytest.mark.parametrize(
    ("name", "value", "text"),
    [
        ("count", 4, "4"),
        ("loud", False, "off"),
        ("glow", 0.25, "0.25"),
        ("hue", "blue", "blue"),
        ("file", Path("x"), "x"),
    ],
)
def test_a_value_is_read_as_it_is_written(name, value, text):
    row = rows(Outer)[name]
    assert row.text(value) == text
    assert row.read(text) == value


def test_values_that_are_several_are_written_with_commas():
    table = rows(Outer)
    assert table["parts"].text(("a", "b")) == "a,b"
    assert table["amounts"].text({"x": 0.5}) == "x:0.5"
    assert table["side"].text((3, 4)) == "3x4"
    assert table["glow"].text(None) == "its own"


def test_names_are_spelled_as_a_sentence_lists_them():
    assert spelled(("a",)) == "a"
    assert spelled(("a", "b", "c")) == "a, b or c"
    assert spelled({"a": "the first", "b": ""}) == "a (the first) or b"


def test_help_has_the_names_and_the_range():
    field = _some("Size", 1.0, "{names}; {low} to {high}.", low=0.5, high=2.0, names=("a", "b"))
    assert field.metadata["setting"].help == "a or b; 0.5 to 2."


def test_names_are_known_or_found_when_they_are_asked_for():
    assert Names(("a", "b")).choices() == (Choice("a"), Choice("b"))
    assert Choice("dark", number=1.0) in Names(path="core.look:COMPLEXIONS").choices()
    policies = Names(path="blend.conflict:POLICIES").choices()
    assert "graded" in [choice.name for choice in policies]
    assert all(choice.description for choice in policies)
