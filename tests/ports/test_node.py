from collections.abc import Callable
from pathlib import Path

import pytest

from risorius.errors import InputError, ParameterError
from risorius.ports import node
from risorius.ports.node import Node, load, parse


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "x:1:1: is not JSON: expecting value"),
        ('{"a": 1,\n "b" 2}', "x:2:6: is not JSON: expecting ':' delimiter"),
        ('{"a": 1, "a": 2}', "x: the key 'a' is given twice in one object"),
        ('{"a": NaN}', "x: NaN is not a number; expected a finite one"),
        ('{"a": -Infinity}', "x: -Infinity is not a number; expected a finite one"),
        ("[" * 100_000, "x: is nested too deeply"),
        ("9" * 10_000, "x: holds a number with too many digits"),
    ],
)
def test_a_text_that_is_no_json_is_refused_with_its_place(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        parse(text, "x")
    assert str(caught.value) == message


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"x\.json: cannot be read: No such file"):
        load(tmp_path / "x.json")


def test_a_folder_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        load(tmp_path)


def test_a_binary_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_bytes(b'{"a": "\xff"}')
    with pytest.raises(InputError, match=r"x\.json: is not UTF-8 text \(byte 7\)"):
        load(tmp_path / "x.json")


def test_a_file_over_the_limit_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(node, "MAX_BYTES", 2_000_000)
    (tmp_path / "x.json").write_text(" " * 2_000_001)
    with pytest.raises(InputError, match="is larger than 2 MB"):
        load(tmp_path / "x.json")


@pytest.mark.parametrize(
    ("value", "ask", "message"),
    [
        ([], Node.members, "p: expected an object {…}, found a list of 0"),
        ({}, Node.items, "p: expected a list […], found an object"),
        ([1], lambda n: n.items(2), "p: expected a list of 2, found a list of 1"),
        ("a", Node.number, 'p: expected a number, found "a"'),
        (True, Node.number, "p: expected a number, found true"),
        (None, Node.number, "p: expected a number, found null"),
        (float("inf"), Node.number, "p: the number is too large"),
        (10**400, Node.number, "p: the number is too large"),
        (-1, lambda n: n.number(low=0.0), "p: -1 is out of range; expected 0 or more"),
        (2, lambda n: n.number(0.0, 1.0), "p: 2 is out of range; expected 0 to 1"),
        (1.5, Node.integer, "p: expected a whole number, found 1.5"),
        (True, Node.integer, "p: expected a whole number, found true"),
        (1, Node.text, "p: expected a text, found 1"),
        (0, Node.flag, "p: expected true or false, found 0"),
        ("x" * 99, Node.flag, f'p: expected true or false, found "{"x" * 39}…'),
        (
            {"onsett": 1},
            lambda n: n.entries(["onset"]),
            "p.onsett: unknown key 'onsett'; did you mean 'onset'?",
        ),
        ({}, lambda n: n.entries(["a"], ["a"]), "p: 'a' is missing"),
    ],
)
def test_another_kind_of_value_is_refused_with_the_path(
    value: object, ask: Callable[[Node], object], message: str
) -> None:
    with pytest.raises(InputError) as caught:
        ask(Node(value, "p"))
    assert str(caught.value) == message


def test_errors_of_others_get_the_path_and_keep_their_kind() -> None:
    with pytest.raises(ParameterError, match=r"^a\[1\]: no such muscle$"), Node(0, "a[1]").located():
        raise ParameterError("no such muscle")
    with pytest.raises(InputError, match=r"^a: wrong$"), Node(0, "a").located():
        raise ValueError("wrong")


def test_paths_name_members_and_items() -> None:
    root = parse('{"a": [{"b": 1}]}', "x")
    (item,) = root.members()["a"].items()
    assert item.members()["b"].path == "a[0].b"
    assert item.members()["b"].number() == 1.0


def test_a_byte_order_mark_is_skipped(tmp_path: Path) -> None:
    (tmp_path / "x.json").write_text("\ufeff[1]", encoding="utf-8")
    assert load(tmp_path / "x.json").value == [1]
