"""The skin of the throat: it gives way before an open jaw folds it over.

The sculpted jaw was made for one throat. On a throat of another age or shape it would fold the skin below the
chin over itself.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, IntArray
from ..numerics.rotations import turned
from .fold_prevention import resolve_folds, struts

LEAST = 0.35  # the share of an edge's length that the open jaw leaves along its direction
SWEEPS = 200


def resolve_throat_folds(
    quads: IntArray, rest: Array, below: float, axis: Array, angle: Array, opened: Array
) -> None:
    """Push crowded skin apart in place: `opened` (N0, 3) mm, the skin under a wide open jaw.

    It is the skin `rest` (N0, 3) turned about `axis` by `angle` (N0,) radians, with the jaw's corrective.
    Only vertices lower than `below` mm at rest move.
    """
    edges = struts(quads)
    edges = edges[(rest[:, 1] < below)[edges].all(axis=1)]
    vector = rest[edges[:, 1]] - rest[edges[:, 0]]
    length = np.linalg.norm(vector, axis=1)
    way = turned(vector / length[:, None], axis, angle[edges].mean(axis=1))
    points = edges[:, [0, 1, 1]].astype(np.int32, "C")
    resolve_folds(
        points, np.zeros(len(points)), way, -LEAST * length, SWEEPS, np.empty(len(points), np.uint32), opened
    )
