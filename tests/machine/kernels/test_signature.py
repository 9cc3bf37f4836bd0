from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
import pytest

from risorius.core.arrays import Array
from risorius.machine.kernels.signature import Record, Value, parse


class Inner(NamedTuple):
    place: Annotated[Array, "f8[:, 3]"]
    count: Annotated[int, "i8"]


class Outer(NamedTuple):
    inner: Inner
    weight: Annotated[Array, "f8[:]"]


class Untold(NamedTuple):
    place: Array


NAMES = {"Outer": Outer, "Untold": Untold, "other": 3}


@pytest.mark.parametrize(
    "text",
    [
        "f8[",
        "f8[:] u4",
        "f8[::1]",
        "x8",
        "Missing",
        "other",
        "Untold",
        "Outer[:]",
        "f8)",
        "(f8",
        "f8 -> Outer",
        "f8 -> u4[:]",
        "f16[:]",
    ],
)
def test_what_is_no_signature_is_refused(text: str) -> None:
    with pytest.raises(TypeError):
        parse(text, NAMES)


def test_a_signature_is_read_as_it_is_written() -> None:
    found = parse("u4[:], Outer, (f8, b1[:, :]) -> i8", NAMES)
    assert found.result == Value("i8")
    kinds = "u4[:]", "f8[:, 3]", "i8", "f8[:]", "f8", "b1[:, :]"
    assert tuple(map(str, found.values)) == kinds
    outer, pair = found.arguments[1:]
    assert isinstance(outer, Record)
    assert isinstance(pair, Record)
    assert (outer.make, pair.make) == (Outer, None)
    assert found.names(["a", "b", "c"]) == ["a", "b.inner.place", "b.inner.count", "b.weight", "c.0", "c.1"]


def test_tuples_are_flattened_if_their_lengths_are_as_declared() -> None:
    found = parse("Outer, (f8, f8)", NAMES)
    place, weight = np.zeros((2, 3)), np.zeros(2)
    flat = found.flatten([Outer(Inner(place, 2), weight), (0.5, 1.0)])
    assert flat is not None
    assert flat[0] is place
    assert flat[1:] == [2, weight, 0.5, 1.0]
    assert found.flatten([Outer(Inner(place, 2), weight), (0.5,)]) is None
    assert found.flatten([place, (0.5, 1.0)]) is None
