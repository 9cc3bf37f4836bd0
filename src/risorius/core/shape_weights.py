"""Weights of ARKit's shapes: an array that also knows the names of its last axis."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import ParameterError, unknown
from .arkit import INDEX, SHAPES
from .arrays import Array


def shape_index(name: str) -> int:
    """Return the column of a shape; raise ParameterError, with the nearest name, for an unknown one."""
    if name not in INDEX:
        raise ParameterError(unknown("shape", name, SHAPES))
    return INDEX[name]


class ShapeWeights(np.ndarray[Any, np.dtype[np.float64]]):
    """An array (…, 52) of weights 0..1 in the order of `names`; `weights["jawOpen"]` is one shape's.

    A part of it without that axis is a plain array.
    """

    @property
    def names(self) -> tuple[str, ...]:
        """ARKit's names of the shapes."""
        return SHAPES

    def __getitem__(self, key: Any) -> Any:
        """Return a shape's weights by its name (ParameterError if unknown), or a part as of any array."""
        if isinstance(key, str):
            if not self._has_shapes:
                raise ParameterError(
                    f"an array of shape {self.shape} has no names; expected (…, {len(SHAPES)})"
                )
            return self.view(np.ndarray)[..., shape_index(key)]
        part = super().__getitem__(key)
        return part.view(np.ndarray) if isinstance(part, ShapeWeights) and not part._has_shapes else part

    @property
    def _has_shapes(self) -> bool:
        return bool(self.shape[-1:] == (len(SHAPES),))


def named_weights(weights: Array) -> ShapeWeights:
    """Return weights (…, 52) with their names; no number is copied."""
    return weights.view(ShapeWeights)
