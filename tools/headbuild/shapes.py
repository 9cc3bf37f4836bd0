"""The 52 sculpted ARKit shapes carried onto a head: fields of the skin, and how the lower teeth move."""

from __future__ import annotations

import numpy as np

from risorius.core.arkit import SHAPES
from risorius.face.head_file import FORMAT

from .arrays import Array
from .build import Shape
from .pack import quantized

_TEETH = "helper-lower-teeth"
_SMALLEST = 0.02  # mm: what a sculpt moves less is left out


def build_shapes(shape: Shape) -> dict[str, Array]:
    """All arrays of the shapes file: per shape a field of the skin, and the lower teeth's way (52, 3) mm."""
    bust = shape.bust
    teeth = bust.source.parts[_TEETH].vertices
    arrays = {
        "format": np.array(FORMAT, np.int32),
        "teeth": np.array([bust.source.shape(name)[teeth].mean(axis=0) for name in SHAPES], np.float32),
    }
    for name in SHAPES:
        for key, values in quantized(bust.shape(name), _SMALLEST).items():
            arrays[f"shape/{name}/{key}"] = values
    return arrays
