import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.ports.layout import write_json

NUMBERS = st.floats(allow_nan=False, allow_infinity=False) | st.integers()
VALUES = st.recursive(
    st.none() | st.booleans() | NUMBERS | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=12,
)


def test_a_number_that_is_not_finite_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="not JSON compliant"):
        write_json(tmp_path / "x.json", {"a": float("nan")})


@given(st.dictionaries(st.text(), VALUES, max_size=5))
def test_a_document_is_read_back_exactly(tmp_path_factory: pytest.TempPathFactory, document: Any) -> None:
    path = tmp_path_factory.mktemp("json") / "x.json"
    write_json(path, document)
    assert json.loads(path.read_text(encoding="utf-8")) == document


def test_half_a_character_pair_is_read_back(tmp_path: Path) -> None:
    write_json(tmp_path / "x.json", {"a": "\udc80"})
    assert json.loads((tmp_path / "x.json").read_text(encoding="utf-8")) == {"a": "\udc80"}


def test_objects_of_a_list_and_long_curves_stand_on_lines_of_their_own(tmp_path: Path) -> None:
    curve = [0.0] * 40
    document = {"n": 1, "list": [{"a": [1, 2]}, {"b": {}}], "empty": [], "curves": {"x": curve, "y": curve}}
    write_json(tmp_path / "x.json", document)
    long = ", ".join(["0.0"] * 40)
    assert (tmp_path / "x.json").read_text() == (
        '{\n  "n": 1,\n  "list": [\n    {"a": [1, 2]},\n    {"b": {}}\n  ],\n  "empty": [],\n'
        f'  "curves": {{\n    "x": [{long}],\n    "y": [{long}]\n  }}\n}}\n'
    )
