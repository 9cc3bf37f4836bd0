"""The 52 sculpted ARKit shapes carried onto a head: fields of the skin, and how the lower teeth move."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from risorius.core.arkit import SHAPES
from risorius.core.arrays import AnyArray
from risorius.face.head_file import FORMAT

from .build import Shape
from .muscles import ironed, read_recipes
from .pack import quantized

_TEETH = "helper-lower-teeth"
_SMALLEST = 0.02  # mm: what a sculpt moves less is left out


def build_shapes(shape: Shape, recipes: Path) -> dict[str, AnyArray]:
    """All arrays of the shapes file: per shape a field of the skin, and the lower teeth's way (52, 3) mm.

    Sharp folds of a sculpt are ironed out as in the muscles made from it (`recipes`): both are one face.
    """
    bust, stiffness = shape.bust, _stiffness(recipes)
    teeth = bust.source.parts[_TEETH].vertices
    arrays = {
        "format": np.array(FORMAT, np.int32),
        "teeth": np.array([bust.source.shape(name)[teeth].mean(axis=0) for name in SHAPES], np.float32),
    }
    for name in SHAPES:
        field = ironed(bust, bust.shape(name), stiffness.get(name, 0.0))
        for key, values in quantized(field, _SMALLEST).items():
            arrays[f"shape/{name}/{key}"] = values
    return arrays


def _stiffness(recipes: Path) -> dict[str, float]:
    """The bending stiffness of each shape: the greatest of the muscles that are made from it."""
    found: dict[str, float] = {}
    for recipe in read_recipes(recipes).values():
        for name in recipe["shapes"]:
            for sided in (name, f"{name}Left", f"{name}Right"):
                found[sided] = max(found.get(sided, 0.0), recipe["smooth"])
    return found
