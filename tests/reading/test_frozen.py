from __future__ import annotations

import pickle

import pytest

from risorius.reading.frozen import FrozenDict

TABLE: FrozenDict[str, float] = FrozenDict({"jaw": 1.0})


@pytest.mark.parametrize(
    ("method", "arguments"),
    [
        ("__setitem__", ("jaw", 2.0)),
        ("__delitem__", ("jaw",)),
        ("__ior__", ({"jaw": 2.0},)),
        ("clear", ()),
        ("pop", ("jaw",)),
        ("popitem", ()),
        ("setdefault", ("open", 2.0)),
        ("update", ({"jaw": 2.0},)),
    ],
)
def test_it_cannot_be_changed(method: str, arguments: tuple[object, ...]) -> None:
    with pytest.raises(TypeError, match="is read-only"):
        getattr(TABLE, method)(*arguments)
    assert TABLE == {"jaw": 1.0}


def test_it_comes_back_from_a_pickle_and_cannot_be_changed_then() -> None:
    again = pickle.loads(pickle.dumps(TABLE))
    assert again == TABLE
    with pytest.raises(TypeError):
        again["jaw"] = 2.0
