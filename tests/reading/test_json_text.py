"""JSON that is read strictly: faults of the text, and of what it says, with line and column."""

from __future__ import annotations

from array import array
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

import pytest

from risorius.errors import InputError, ParameterError
from risorius.reading import json_text
from risorius.reading.hints import ChooseType, Numbers, Range, Then
from risorius.reading.json_text import load_json, parse_json
from risorius.reading.schema import MisfitError


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "x:1:1: is not JSON: expecting value"),
        ('{"a": 1,\n "b" 2}', "x:2:6: is not JSON: expecting ':' delimiter"),
        ('{"a": 1, "a": 2}', "x: the key 'a' is given twice in one object; expected it once"),
        ('{"a": NaN}', "x: NaN is not a number; expected a finite one"),
        ('{"a": -Infinity}', "x: -Infinity is not a number; expected a finite one"),
        ("[" * 100_000, "x: is nested too deeply; expected at most 32 levels"),
        ("9" * 10_000, "x: holds a number with too many digits; expected fewer"),
    ],
)
def test_a_text_that_is_not_json_is_refused_with_its_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse_json(text, "x")
    assert str(caught.value) == message


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"x\.json: cannot be read: No such file"):
        load_json(tmp_path / "x.json")


def test_a_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        load_json(tmp_path)


def test_a_binary_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_bytes(b'{"a": "\xff"}')
    with pytest.raises(InputError, match=r"x\.json: is not UTF-8 text \(byte 7\)"):
        load_json(tmp_path / "x.json")


def test_a_file_over_the_limit_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(json_text, "MAX_BYTES", 2_000_000)
    (tmp_path / "x.json").write_text(" " * 2_000_001)
    with pytest.raises(InputError, match="is larger than 2 MB"):
        load_json(tmp_path / "x.json")


def test_a_byte_order_mark_is_skipped(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text("\ufeff[1]", encoding="utf-8")
    assert load_json(tmp_path / "x.json").data == [1]


class Kind(StrEnum):
    ONE = "one"
    TWO = "two"


@dataclass(frozen=True)
class Round:
    kind: Literal["round"]
    radius: float


@dataclass(frozen=True)
class Square:
    kind: Literal["square"]
    side: float

    def __post_init__(self) -> None:
        if self.side == 13.0:
            raise ParameterError("13 brings bad luck")


def _shape(members: Mapping[str, object]) -> type:
    if members.get("kind") not in ("round", "square"):
        raise MisfitError("no such shape", "kind")
    return Round if members["kind"] == "round" else Square


def _even(number: int) -> int:
    if number % 2:
        raise InputError("is odd; expected an even number")
    return number


def _sorted(numbers: tuple[int, ...]) -> tuple[int, ...]:
    for index in range(1, len(numbers)):
        if numbers[index] < numbers[index - 1]:
            raise MisfitError("falls; expected rising numbers", index)
    return numbers


@dataclass(frozen=True)
class Item:
    name: str
    size: Annotated[float, Range(0.0, 1.0)] = 0.0
    count: int = 0
    flag: bool = True
    kind: Kind = Kind.ONE
    limit: float | None = None
    rate: str | float = 0.0
    choice: Literal[1, 2] = 1
    curve: Numbers = field(default_factory=lambda: array("d"))
    even: Annotated[int, Then(_even)] = 0
    length: Annotated[int, Then(len, of=str)] = 0
    rising: Annotated[tuple[int, ...], Then(_sorted)] = ()
    shapes: tuple[Annotated[Round | Square, ChooseType(_shape)], ...] = ()
    sides: Mapping[Literal["left", "right"], float] = field(default_factory=dict)
    inner: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    free: Mapping[str, object] = field(default_factory=dict)


BAD = [
    ("[]", "x: holds []; expected an object"),
    ("3", "x: holds 3; expected an object"),
    ("{}", "x: key 'name' is missing; expected a text"),
    ('"cuont": 1', "x:2:1: unknown key 'cuont'; did you mean 'count'?"),
    ('"name": null', "x:2:1: name = null cannot be used; expected a text"),
    ('"size": "1"', 'x:2:1: size = "1" cannot be used; expected a number from 0 to 1'),
    ('"size": true', "x:2:1: size = true cannot be used; expected a number from 0 to 1"),
    ('"size": -1', "x:2:1: size = -1 is out of range; expected a number from 0 to 1"),
    ('"size": 1e999', "x:2:1: size is too large; expected a number"),
    (f'"size": 1{"0" * 400}', "x:2:1: size is too large; expected a number"),
    (f'"size": {"9" * 5000}', "x: holds a number with too many digits; expected fewer"),
    ('"count": 1.5', "x:2:1: count = 1.5 cannot be used; expected a whole number"),
    ('"count": true', "x:2:1: count = true cannot be used; expected a whole number"),
    (f'"count": 1{"0" * 40}', "x:2:1: count is too large; expected at most 40 digits"),
    (f'"name": 1{"0" * 50}', "x:2:1: name = a number of more than 40 digits cannot be used; expected a text"),
    ('"flag": 0', "x:2:1: flag = 0 cannot be used; expected true or false"),
    ('"kind": "twoo"', 'x:2:1: kind = "twoo" cannot be used; expected one of one, two'),
    ('"kind": ["one"]', 'x:2:1: kind = ["one"] cannot be used; expected one of one, two'),
    ('"choice": true', "x:2:1: choice = true cannot be used; expected one of 1, 2"),
    ('"limit": {}', "x:2:1: limit = an object cannot be used; expected a number"),
    ('"rate": []', "x:2:1: rate = [] cannot be used; expected a number or a text"),
    ('"curve": 1', "x:2:1: curve = 1 cannot be used; expected a list of numbers"),
    ('"curve": [1, true]', "x:2:14: curve[1] = true cannot be used; expected a number"),
    ('"curve": [1, 1e999]', "x:2:14: curve[1] is too large; expected a number"),
    ('"even": 3', "x:2:1: is odd; expected an even number"),
    ('"length": 3', "x:2:1: length = 3 cannot be used; expected a text"),
    ('"rising": [1, 3, 2]', "x:2:18: falls; expected rising numbers"),
    ('"shapes": [1]', "x:2:12: shapes[0] = 1 cannot be used; expected an object"),
    ('"shapes": [{"kind": "oval"}]', "x:2:13: no such shape"),
    (
        '"shapes": [{"kind": "round", "side": 1}]',
        "x:2:30: unknown key 'shapes[0].side'; expected one of kind, radius",
    ),
    ('"shapes": [{"kind": "square", "side": 13}]', "x:2:12: 13 brings bad luck"),
    ('"sides": {"left": 1, "rihgt": 1}', "x:2:22: unknown key 'sides.rihgt'; did you mean 'right'?"),
    (
        '"inner": {"a": [1, 2], "b": [1]}',
        "x:2:24: inner.b = [1] cannot be used; expected a list of 2, each a number",
    ),
    ('"inner": {"a": [1, "2"]}', 'x:2:20: inner.a[1] = "2" cannot be used; expected a number'),
    (f'"flag": "{"x" * 99}"', f'x:2:1: flag = "{"x" * 38}… cannot be used; expected true or false'),
    (f'"flag": [{"1, " * 99}1]', "x:2:1: flag = a list of 100 cannot be used; expected true or false"),
]


@pytest.mark.parametrize(("text", "message"), BAD, ids=[message[:40] for _, message in BAD])
def test_what_does_not_fit_is_refused_with_its_place(text: str, message: str) -> None:
    if text.startswith('"'):
        text = "{\n" + text + ("}" if text.startswith('"name"') else ', "name": "a"}')
    with pytest.raises(InputError) as caught:
        parse_json(text, "x").read(Item)
    assert str(caught.value) == message


def test_an_error_of_a_dataclass_keeps_its_kind() -> None:
    with pytest.raises(ParameterError, match="13 brings bad luck"):
        parse_json('{"kind": "square", "side": 13}', "x").read(Square)


def test_a_full_object_is_read_with_its_types() -> None:
    text = """{"name": "a", "size": 1, "count": 2, "flag": false, "kind": "two", "limit": null, "rate": "3",
        "choice": 2, "curve": [1, 2.5], "even": 4, "length": "four", "rising": [1, 2],
        "shapes": [{"kind": "round", "radius": 1}], "sides": {"left": 1}, "inner": {"a": [1, 2]},
        "free": {"b": [null, {"c": 1}]}}"""
    assert parse_json(text, "x").read(Item) == Item(
        name="a",
        size=1.0,
        count=2,
        flag=False,
        kind=Kind.TWO,
        rate="3",
        choice=2,
        curve=array("d", [1.0, 2.5]),
        even=4,
        length=4,
        rising=(1, 2),
        shapes=(Round("round", 1.0),),
        sides={"left": 1.0},
        inner={"a": (1.0, 2.0)},
        free={"b": [None, {"c": 1}]},
    )


def test_an_object_within_a_text_is_read_with_its_place() -> None:
    document = parse_json('{"items": [\n{"name": 1}]}', "x")
    inner = json_text.JsonDocument(document.data["items"][0], document.source)  # type: ignore[index]
    with pytest.raises(InputError, match=r"^x:2:2: items\[0\]\.name = 1 cannot be used"):
        inner.read(Item, ("items", 0))
