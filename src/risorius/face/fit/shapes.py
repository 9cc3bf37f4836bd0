"""The 52 ARKit shapes of a head: sculpted shapes from its `shapes.npz`, but its own contact of lids and lips.

The sculpted `eyeBlink` moves the lids past each other by a third at weight 1, so that weight 0.66 would close
the eye, and a character that uses the weights would never close its own. So some shapes are the face's own
(`contact_shapes`).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from ...core.arkit import INDEX, SHAPES
from ...core.arrays import Array
from ...core.parameters import INDEX as PARAMETER
from ...core.parameters import NEUTRAL
from ...errors import HeadError, Place
from ..head.head import Head
from ..head.head_file import HeadFile
from ..muscles.jaw import Jaw
from ..muscles.tongue import TongueShapes
from .contact_shapes import contact_shapes

FILE = "shapes.npz"
_JAW_OPEN, _TONGUE_OUT = INDEX["jawOpen"], INDEX["tongueOut"]


@dataclass(frozen=True, slots=True, eq=False)
class ArkitShapes:
    """Displacements in mm at weight 1, one row per shape in the order of `core.arkit.SHAPES`.

    skin         CSR (52, 3 N1), the level-1 skin, vertex by vertex
    teeth_lower  (52, n, 3) the lower row of teeth
    tongue       (52, n1, 3) the level-1 tongue
    """

    skin: sp.csr_matrix
    teeth_lower: Array
    tongue: Array

    def skin_at(self, shape: int) -> Array:
        """Return the displacement (N1, 3) of the skin by one shape."""
        return np.asarray(self.skin[[shape]].toarray().reshape(-1, 3))


def arkit_shapes(head: Head) -> ArkitShapes:
    """Return the shapes of `head`; raise HeadError if its folder has none or they do not fit."""
    path = head.folder / FILE
    if not path.is_file():
        raise HeadError(
            f"head '{head.name}' has no ARKit shapes; expected {FILE} in its folder", Place(str(path))
        )
    return _shapes(head, path, path.stat().st_mtime_ns)


@lru_cache(maxsize=4)
def _cached(path: Path, changed: int, count: int) -> tuple[tuple[Array, ...], Array]:
    file = HeadFile.read(path)
    fields = []
    for name in SHAPES:
        field = np.zeros((count, 3))
        if _moves(file, name):
            vertices, displacement = file.field(f"shape/{name}", count)
            field[vertices] = displacement
        fields.append(field)
    return tuple(fields), file.array("teeth", (len(SHAPES), 3))


def _moves(file: HeadFile, name: str) -> bool:
    return file.arrays.get(f"shape/{name}/vertices", np.ones(1)).size > 0


def _shapes(head: Head, path: Path, changed: int) -> ArkitShapes:
    fields, shifts = _cached(path, changed, len(head.rest))
    fine = [sp.csr_matrix((head.skin.matrix @ field).reshape(1, -1)) for field in fields]
    for shape, moved in contact_shapes(head, fields):
        fine[shape] = sp.csr_matrix(moved.reshape(1, -1))
    jaw, tongue = Jaw.of(head), TongueShapes.of(head)
    teeth = np.repeat(shifts[:, None], len(head.teeth_lower.vertices), axis=1)
    teeth[_JAW_OPEN] = jaw.carry(head.teeth_lower.vertices, 1.0) - head.teeth_lower.vertices
    rest = tongue.place(NEUTRAL, jaw, 0.0)
    with_jaw = np.repeat(shifts[:, None], len(rest), axis=1)
    with_jaw[_JAW_OPEN] = tongue.place(NEUTRAL, jaw, 1.0) - rest
    out = NEUTRAL.copy()
    out[PARAMETER["tongue_out"]] = 1.0
    with_jaw[_TONGUE_OUT] = tongue.place(out, jaw, 0.0) - rest
    return ArkitShapes(sp.vstack(fine).tocsr(), teeth, with_jaw)
