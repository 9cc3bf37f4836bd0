"""VRM's preset expressions from ARKit weights, by the table `face/data/expressions.toml`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources

import numpy as np

from ..core.arkit import INDEX
from ..core.arrays import Array
from ..core.frozen import FrozenDict
from ..core.toml import parse_rows
from ..errors import InputError, unknown

FILE = "expressions.toml"


@dataclass(frozen=True, slots=True)
class Expression:
    """A preset: its name in VRM 0, and its ARKit shapes with their weights."""

    vrm0: str
    shapes: Mapping[str, float]


@lru_cache(maxsize=1)
def expressions() -> Mapping[str, Expression]:
    """Return the presets by their name in VRM 1; raise InputError if the table names an unknown shape."""
    text = (resources.files(__package__) / "data" / FILE).read_text(encoding="utf-8")
    presets = parse_rows(Expression, text, FILE)
    for expression in presets.values():
        for name in expression.shapes:
            if name not in INDEX:
                raise InputError(f"{FILE}: {unknown('shape', name, INDEX)}")
    return FrozenDict(presets)


def preset_weights(weights: Array) -> Array:
    """Return the presets' weights (frames, presets) 0..1 of ARKit weights (frames, 52)."""
    matrix = np.zeros((weights.shape[1], len(expressions())))
    for column, expression in enumerate(expressions().values()):
        for name, amount in expression.shapes.items():
            matrix[INDEX[name], column] = amount
    return np.clip(weights @ matrix, 0.0, 1.0)
