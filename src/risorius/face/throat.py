"""The skin of the throat, which an open jaw pushes together: it gives way before it folds over.

The sculpted jaw was made for one throat. On another, of another age or shape, it would lay the skin below the
chin over itself.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array, IntArray
from .crowding import relieve, struts
from .rotations import turned

LEAST = 0.35  # of an edge's length along its direction that the open jaw leaves
SWEEPS = 200


def uncrowd(quads: IntArray, rest: Array, below: float, axis: Array, angle: Array, opened: Array) -> None:
    """Push the skin `opened` (N0, 3), mm, of a wide open jaw apart in place where it is crowded.

    It is that of `rest` (N0, 3), turned about `axis` by `angle` (N0,) radians and then some; only what lies
    lower than `below` mm at rest is moved.
    """
    edges = struts(quads)
    edges = edges[(rest[:, 1] < below)[edges].all(axis=1)]
    vector = rest[edges[:, 1]] - rest[edges[:, 0]]
    length = np.linalg.norm(vector, axis=1)
    way = turned(vector / length[:, None], axis, angle[edges].mean(axis=1))
    points = edges[:, [0, 1, 1]].astype(np.int32, "C")
    relieve(points, np.zeros(len(points)), way, -LEAST * length, SWEEPS, opened)
