"""VRM's preset expressions from ARKit weights, by the table `face/fit/data/expressions.toml`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated

import numpy as np

from ...core.arkit import INDEX
from ...core.arrays import Array
from ...errors import InputError, unknown
from ...reading.frozen import FrozenDict
from ...reading.hints import Range
from ...reading.toml import package_text, parse_rows

FILE = "expressions.toml"


@dataclass(frozen=True, slots=True)
class Expression:
    """A preset: its name in VRM 0, and its ARKit shapes with their weights."""

    vrm0: str
    shapes: Mapping[str, Annotated[float, Range(-2.0, 2.0)]]

    def __post_init__(self) -> None:
        for name in self.shapes:
            if name not in INDEX:
                raise InputError(unknown("shape", name, INDEX))


@lru_cache(maxsize=1)
def expressions() -> Mapping[str, Expression]:
    """Return the presets by their name in VRM 1; raise InputError if the table names an unknown shape."""
    return FrozenDict(parse_rows(Expression, package_text(str(__package__), FILE), FILE))


def preset_weights(weights: Array) -> Array:
    """Return the presets' weights (frames, presets) 0..1 of ARKit weights (frames, 52)."""
    matrix = np.zeros((weights.shape[1], len(expressions())))
    for column, expression in enumerate(expressions().values()):
        for name, amount in expression.shapes.items():
            matrix[INDEX[name], column] = amount
    return np.clip(weights @ matrix, 0.0, 1.0)
