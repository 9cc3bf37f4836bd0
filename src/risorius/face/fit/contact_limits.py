"""The contact of lips and lids as limits of a fit of shapes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...core.arrays import Array, BoolArray, FloatArray, IntArray
from ..head.head import Head
from .lid_limits import LidLimits, lid_vertices
from .lip_limits import LipLimits
from .mouth_gap import MouthGap


class ContactLimits:
    """The limits of one head's lips and lids, for a fit with the normal equations `normal` (52, 52).

    `moved` tells how far the fit's unknowns displace some of the vertices of the skin `rest` (N1, 3):
    indices (k,) -> (52, k, 3) mm; `free` (52,): the shapes that the fit may use.
    """

    def __init__(
        self, head: Head, rest: Array, moved: Callable[[IntArray], Array], normal: Array, free: BoolArray
    ) -> None:
        gap = MouthGap.of(head)
        lips, lids = gap.vertices.ravel(), lid_vertices(head, rest).ravel()
        self._vertices, self._split = np.concatenate((lips, lids)), len(lips)
        self._form = (-1, *gap.vertices.shape, 3)
        points = moved(self._vertices)
        at_rest, ways = self._apart(self.points(rest)[None]), self._apart(points)
        self._lips = LipLimits(gap, ways[0], at_rest[0][0], normal, free)
        self._lids = LidLimits(ways[1], at_rest[1][0], free)

    def points(self, skin: FloatArray) -> Array:
        """Return the places (k, 3) mm of the vertices that touch, on a level-1 skin (N1, 3)."""
        return np.asarray(skin.take(self._vertices, axis=0), dtype=np.float64)

    def keep(self, weights: Array, points: Array) -> None:
        """Change the weights (n, 52) in place: they touch where the faces with `points` (n, k, 3) do."""
        lips, lids = self._apart(points)
        self._lids.keep(weights, lids)
        self._lips.keep(weights, lips)

    def _apart(self, points: Array) -> tuple[Array, Array]:
        """Return the vertices of the lips' gap (n, 19, 4, 3) and of the lids (n, 28, 3)."""
        return points[:, : self._split].reshape(self._form), points[:, self._split :]
