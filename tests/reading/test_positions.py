"""Where values stand: every key and item of a text is found where it was written."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.reading.positions import KeyPath, json_position, toml_position
from risorius.reading.toml import written

TOML = '''# a = [1]
a = 1
[t]
b = 2 # c = 3
c.d = 3
"e f" = 4
lists = [1, [2, """3, [
x = 1"""], { y = 5, z.w = [6] }, # 7,
  8]
'literal' = '[t]'
time = 12:00:00
[[row]]
x = 1
[row.inner]
y = 2
[[row]]
x = 3
[[row.inner.many]]
z = 4
[ spaced . "key" ]
v = true
'''


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ((), None),
        (("u",), None),
        (("a",), "a = 1\n"),
        (("t",), "[t]"),
        (("t", "b"), "b = 2"),
        (("t", "c", "d"), "c.d = 3"),
        (("t", "c"), "c.d = 3"),
        (("t", "e f"), '"e f"'),
        (("t", "none"), "[t]"),
        (("t", "lists"), "lists"),
        (("t", "lists", 0), "1, [2"),
        (("t", "lists", 1), "[2, "),
        (("t", "lists", 1, 1), '"""3'),
        (("t", "lists", 2), "{ y = 5"),
        (("t", "lists", 2, "y"), "y = 5"),
        (("t", "lists", 2, "z", "w", 0), "6]"),
        (("t", "lists", 3), "8]"),
        (("t", "lists", 4), "lists"),
        (("t", "literal"), "'literal'"),
        (("t", "time"), "time"),
        (("row",), "[[row]]\nx = 1"),
        (("row", 0, "x"), "x = 1\n[row"),
        (("row", 0, "inner", "y"), "y = 2"),
        (("row", 1), "[[row]]\nx = 3"),
        (("row", 1, "x"), "x = 3"),
        (("row", 1, "inner", "many", 0, "z"), "z = 4"),
        (("spaced", "key", "v"), "v = true"),
        (("spaced",), "[ spaced"),
    ],
)
def test_values_of_toml_are_found(path: KeyPath, text: str | None) -> None:
    at = toml_position(TOML, path)
    assert at is None if text is None else at is not None and TOML[at:].startswith(text)


KEYS = st.text('ab"\\\n[]{}=.#é', min_size=1, max_size=4)
LEAVES = st.integers(-9, 9) | st.booleans() | st.text('x"\\[]{},#=\n', max_size=5) | st.floats(-1.0, 1.0)


def _marked(value: Any, path: KeyPath, marks: dict[KeyPath, str]) -> Any:
    """Give every key a number, so that it occurs once in the text, and note what stands at its path."""
    if isinstance(value, dict):
        marked = {}
        for key, item in value.items():
            name = f"{key}~{len(marks)}~"
            marks[(*path, name)] = name
            marked[name] = _marked(item, (*path, name), marks)
        return marked
    if isinstance(value, list):
        return [_marked(item, (*path, number), marks) for number, item in enumerate(value)]
    return value


JSON = st.recursive(
    LEAVES | st.none(), lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3)
)


@given(st.dictionaries(KEYS, JSON, max_size=4), st.sampled_from([None, 1]))
def test_every_key_of_json_is_found(data: dict[str, Any], indent: int | None) -> None:
    marks: dict[KeyPath, str] = {}
    text = json.dumps(_marked(data, (), marks), indent=indent)
    for path, name in marks.items():
        at = json_position(text, path)
        assert at is not None
        assert text[at:].startswith(json.dumps(name))


TABLES = st.recursive(
    st.dictionaries(KEYS, LEAVES | st.lists(LEAVES, max_size=3), max_size=3),
    lambda inner: st.dictionaries(KEYS, LEAVES | inner, max_size=3),
    max_leaves=6,
)


@given(TABLES)
def test_every_key_of_toml_is_found(tables: dict[str, Any]) -> None:
    marks: dict[KeyPath, str] = {}
    text = written(_marked(tables, (), marks))
    for path, name in marks.items():
        at = toml_position(text, path)
        assert at is not None
        # A table may stand in a header only, after the names of those around it.
        line = re.match(r"[^\n]*", text[at:])
        assert line is not None
        assert json.dumps(name, ensure_ascii=False)[1:-1] in line[0]


def test_items_of_json_are_found() -> None:
    text = '{"a": [1,\n {"b": [2, 3]}]}'
    for path, rest in ((("a", 0), "1,"), (("a", 1), "{"), (("a", 1, "b", 1), "3]"), (("a", 7), '"a"')):
        at = json_position(text, path)
        assert at is not None
        assert text[at:].startswith(rest)
    assert json_position("[]", (0,)) is None
    assert json_position("3", ("a",)) is None
