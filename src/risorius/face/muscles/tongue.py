"""The tongue: raised, put out or drawn back, and carried by the jaw.

A rigid tongue would fill the open mouth like a wall. As the jaw opens, the tongue lies down behind the lower
teeth and draws back a little, unless it is raised or put out, so that the back of the mouth is visible.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ...core.arrays import Array, IndexArray
from ...core.parameters import INDEX
from ...machine.kernels.jit import kernel
from ..head.head import TONGUE_FIELDS, Head
from .jaw import Jaw

LYING = 0.62  # share of its height above its floor that the tongue loses with the jaw wide open
SUNK, DRAWN_BACK = 12.0, 6.0  # mm by which its back sinks and its tip draws back with the jaw wide open
VAULT = 6.0  # mm by which its edges sink further than its middle with the jaw wide open: it is not flat
STANDS_UP_TO = 0.1  # opening of the jaw up to which it keeps its height: consonants need no more
_OUT = TONGUE_FIELDS.index("tongue_out")
OVER = 5.0  # mm that the tip rises halfway out, so that it passes over the lower teeth, not through them
COLUMNS = 12  # places along its length at which its floor is measured


@dataclass(frozen=True, slots=True)
class TongueShapes:
    """The tongue at level 1: `rest` (n1, 3) mm, and its displacements in mm.

    `shapes` (3, n1, 3): at activation 1; `over` (n1,): upwards, halfway out; `lying` (n1, 3): in the wide
    open mouth. `columns` (3,): the parameters of the shapes.
    """

    rest: Array
    shapes: Array
    over: Array
    lying: Array
    columns: IndexArray

    @classmethod
    def of(cls, head: Head) -> TongueShapes:
        """Subdivide the tongue of `head` and its fields once (subdivision is linear)."""
        tongue = head.tongue
        matrix: sp.csr_matrix = tongue.subdivision.matrix
        shapes = np.zeros((len(TONGUE_FIELDS), *tongue.rest.shape))
        for shape, name in zip(shapes, TONGUE_FIELDS, strict=True):
            shape[tongue.fields[name].vertices] = tongue.fields[name].displacement
        columns = np.array([INDEX[name] for name in TONGUE_FIELDS])
        rest = matrix @ tongue.rest
        fine = np.stack([matrix @ shape for shape in shapes])
        forward = np.maximum(fine[_OUT, :, 2], 0.0)
        return cls(rest, fine, OVER * forward / max(forward.max(), 1e-9), _lying(rest), columns)

    def place(self, values: Array, jaw: Jaw, opening: float, out: Array | None = None) -> Array:
        """Return the tongue (n1, 3) mm for `values` (46,) with the jaw at `opening`, perhaps in `out`."""
        moved = np.empty_like(self.rest) if out is None else out
        active = values[self.columns]
        opened = min(max((opening - STANDS_UP_TO) / (1.0 - STANDS_UP_TO), 0.0), 1.0)
        lying = opened * (2.0 - opened) * (1.0 - float(active.max()))
        way = float(active[_OUT])
        _shape(self.rest, self.shapes, active, self.lying, lying, self.over, 4.0 * way * (1.0 - way), moved)
        jaw.carry_to(moved, opening, moved)
        return moved


@kernel("f8[:, :], f8[:, :, :], f8[:], f8[:, :], f8, f8[:], f8, f8[:, :]")
def _shape(
    rest: Array,
    shapes: Array,
    active: Array,
    lying: Array,
    lies: float,
    over: Array,
    halfway: float,
    out: Array,
) -> None:
    for v in range(len(rest)):
        for c in range(3):
            out[v, c] = rest[v, c] + lies * lying[v, c]
        out[v, 1] += halfway * over[v]
    for s in range(len(active)):
        if active[s] != 0.0:
            for v in range(len(rest)):
                for c in range(3):
                    out[v, c] += active[s] * shapes[s, v, c]


def _lying(rest: Array) -> Array:
    """Return the displacement (n, 3) mm with which the tongue `rest` (n, 3) lies down."""
    y, z = rest[:, 1], rest[:, 2]
    places = np.linspace(z.min(), z.max(), COLUMNS)
    width = places[1] - places[0]
    floor = np.interp(z, places, [y[np.abs(z - at) <= width].min() for at in places])
    front = (z - z.min()) / (z.max() - z.min())
    aside = rest[:, 0] / np.abs(rest[:, 0]).max()
    sunk = LYING * (y - floor) + SUNK * (1.0 - front**2) + VAULT * aside**2
    return np.stack([np.zeros(len(rest)), -sunk, -DRAWN_BACK * front**2], axis=1)
