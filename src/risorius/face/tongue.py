"""The tongue: raised, put out or drawn back, and carried by the jaw."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..core.parameters import INDEX
from .head import TONGUE_FIELDS, Head
from .jaw import Jaw

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class TongueShapes:
    """The tongue at level 1: `rest` (n1, 3) mm and `shapes` (3, n1, 3), its displacements at activation 1."""

    rest: Array
    shapes: Array
    columns: npt.NDArray[np.intp]

    @classmethod
    def of(cls, head: Head) -> TongueShapes:
        """Subdivide the tongue of `head` and its fields once (subdivision is linear)."""
        tongue = head.tongue
        matrix: sp.csr_matrix = tongue.subdivision.matrix
        shapes = np.zeros((len(TONGUE_FIELDS), *tongue.rest.shape))
        for shape, name in zip(shapes, TONGUE_FIELDS, strict=True):
            shape[tongue.fields[name].vertices] = tongue.fields[name].displacement
        columns = np.array([INDEX[name] for name in TONGUE_FIELDS])
        return cls(matrix @ tongue.rest, np.stack([matrix @ shape for shape in shapes]), columns)

    def place(self, values: Array, jaw: Jaw, opening: float) -> Array:
        """Return the tongue (n1, 3) in mm for `values` (46,), with the jaw at `opening` 0..1."""
        moved = self.rest + np.tensordot(values[self.columns], self.shapes, axes=1)
        return jaw.carry(moved, opening)
