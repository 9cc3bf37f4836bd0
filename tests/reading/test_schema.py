from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

import pytest

from risorius.errors import InputError, ParameterError
from risorius.reading.hints import Range
from risorius.reading.toml import load_file, parse


class Colour(StrEnum):
    RED = "red"
    BLUE = "blue"


@dataclass(frozen=True)
class Inner:
    when: str
    size: Annotated[float, Range(0.0, 1.0)]


@dataclass(frozen=True)
class Table:
    name: str
    count: int = 0
    loud: bool = False
    side: Literal["left", "right"] = "left"
    colour: Colour = Colour.RED
    span: tuple[float, float] = (0.0, 1.0)
    words: tuple[str, ...] = ()
    weights: Mapping[str, Annotated[float, Range(0.0)]] = field(default_factory=dict)
    note: str | None = None
    rules: tuple[Inner, ...] = field(default=(), metadata={"key": "rule"})
    main: Inner | None = None


@dataclass(frozen=True)
class Checked:
    value: float

    def __post_init__(self) -> None:
        if self.value == 13.0:
            raise ParameterError("13 brings bad luck")


NAMED = 'name = "x"\n'
BAD = [
    ("unknown key", NAMED + "cuont = 1", "t.toml:2:1: unknown key 'cuont'; did you mean 'count'?"),
    ("missing key", "count = 1", "t.toml: key 'name' is missing; expected a text"),
    (
        "text for number",
        NAMED + 'count = "3"',
        't.toml:2:1: count = "3" cannot be used; expected a whole number',
    ),
    ("number for text", "name = 3", "t.toml:1:1: name = 3 cannot be used; expected a text"),
    (
        "bool for number",
        NAMED + "count = true",
        "t.toml:2:1: count = true cannot be used; expected a whole number",
    ),
    ("number for bool", NAMED + "loud = 1", "t.toml:2:1: loud = 1 cannot be used; expected true or false"),
    (
        "not a choice",
        NAMED + 'side = "up"',
        't.toml:2:1: side = "up" cannot be used; expected one of left, right',
    ),
    (
        "not in enum",
        NAMED + 'colour = "x"',
        't.toml:2:1: colour = "x" cannot be used; expected one of red, blue',
    ),
    (
        "list too long",
        NAMED + "span = [1, 2, 3]",
        "t.toml:2:1: span = [1, 2, 3] cannot be used; expected a list of 2, each a number",
    ),
    (
        "text for list",
        NAMED + 'words = "a"',
        't.toml:2:1: words = "a" cannot be used; expected a list, each a text',
    ),
    ("wrong item", NAMED + "words = [1]", "t.toml:2:10: words[0] = 1 cannot be used; expected a text"),
    ("nan", NAMED + "span = [nan, 1]", "t.toml:2:9: span[0] = nan cannot be used; expected a number"),
    (
        "free key, bad value",
        NAMED + "\n[weights]\na = -1",
        "t.toml:4:1: weights.a = -1 is out of range; expected a number of at least 0",
    ),
    ("number for table", NAMED + "main = 1", "t.toml:2:1: main = 1 cannot be used; expected a table"),
    (
        "second rule",
        NAMED + '[[rule]]\nwhen = "a"\nsize = 1\n[[rule]]\nwhen = "b"\nsize = 2',
        "t.toml:7:1: rule[1].size = 2 is out of range; expected a number from 0 to 1",
    ),
    (
        "key of a rule",
        NAMED + '[[rule]]\nwhne = "a"\nsize = 1',
        "t.toml:3:1: unknown key 'rule[0].whne'; did you mean 'when'?",
    ),
    ("no TOML", NAMED + "count = \n", "t.toml:2:9: is not a TOML file: Invalid value"),
]


@pytest.mark.parametrize(("text", "message"), [row[1:] for row in BAD], ids=[row[0] for row in BAD])
def test_bad_tables_are_refused_with_their_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse(Table, text, "t.toml")
    assert str(caught.value) == message


def test_what_a_table_refuses_itself_is_given_its_place() -> None:
    with pytest.raises(ParameterError, match=r"^t\.toml: 13 brings bad luck$"):
        parse(Checked, "value = 13", "t.toml")


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    latin = tmp_path / "latin.toml"
    latin.write_bytes(b'name = "\xe9"')
    with pytest.raises(InputError, match="is not UTF-8 text"):
        load_file(Table, latin)
    with pytest.raises(InputError, match="cannot be read: No such file"):
        load_file(Table, tmp_path / "none.toml")


def test_a_full_table_is_read_with_its_types(tmp_path: Path) -> None:
    text = """\
name = "x"
count = 2
loud = true
side = "right"
colour = "blue"
span = [1, 2.5]
words = ["a", "b"]
note = "n"
weights = { a = 1, "AU12.left" = 0.5 }
main = { when = "m", size = 1 }

[[rule]]
when = "a"
size = 0.5
"""
    path = tmp_path / "t.toml"
    path.write_text(text)
    assert load_file(Table, path) == Table(
        "x",
        2,
        True,
        "right",
        Colour.BLUE,
        (1.0, 2.5),
        ("a", "b"),
        {"a": 1.0, "AU12.left": 0.5},
        "n",
        (Inner("a", 0.5),),
        Inner("m", 1.0),
    )


def test_what_is_left_out_has_its_default() -> None:
    assert parse(Table, NAMED, "t.toml") == Table("x")
