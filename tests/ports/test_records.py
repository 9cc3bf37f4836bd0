from dataclasses import dataclass
from enum import StrEnum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError
from risorius.ports.node import Node
from risorius.ports.records import from_record, to_record


class Kind(StrEnum):
    ONE = "one"
    TWO = "two"


@dataclass(frozen=True)
class Item:
    name: str
    size: float
    count: int = 0
    flag: bool = True
    kind: Kind = Kind.ONE
    limit: float | None = None


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"name": "a"}, "p: 'size' is missing"),
        ({"name": "a", "size": 1, "cuont": 1}, "p.cuont: unknown key 'cuont'; did you mean 'count'?"),
        ({"name": "a", "size": "1"}, 'p.size: expected a number, found "1"'),
        ({"name": "a", "size": 1, "kind": "twoo"}, "p.kind: unknown value 'twoo'; did you mean 'two'?"),
        ({"name": None, "size": 1}, "p.name: expected a text, found null"),
    ],
)
def test_what_does_not_fit_is_refused(value: object, message: str) -> None:
    with pytest.raises(InputError) as caught:
        from_record(Item, Node(value, "p"))
    assert str(caught.value) == message


def test_defaults_are_left_out_and_come_back() -> None:
    assert to_record(Item("a", 1.0, kind=Kind.TWO)) == {"name": "a", "size": 1.0, "kind": "two"}
    assert from_record(Item, Node({"name": "a", "size": 1, "limit": None})) == Item("a", 1.0)


@given(
    st.builds(
        Item,
        st.text(),
        st.floats(allow_nan=False, allow_infinity=False),
        st.integers(),
        st.booleans(),
        st.sampled_from(Kind),
        st.none() | st.floats(0, 1),
    )
)
def test_a_record_is_read_back(item: Item) -> None:
    assert from_record(Item, Node(to_record(item))) == item
