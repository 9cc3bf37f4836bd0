"""The lids' contact as a limit of a fit of shapes: eyes that a face shuts are shut by its weights.

Squints, raised cheeks and lowered brows move lids too, and a fit that trades them against `eyeBlink` leaves
shut lids up to a millimetre apart. So `eyeBlink` rises, or `eyeWide` falls, until the gap is the face's own;
over open eyes more is allowed, so that a look stays what it is.
"""

from __future__ import annotations

import numpy as np

from ...core.arkit import INDEX
from ...core.arrays import Array, BoolArray, Int32Array
from ..head.head import Head

PLACES = 7  # of each eye: the pairs of vertices that are widest apart at rest
WIDER, OPEN = 0.12, 0.15  # mm that a gap may be wider than the face's, and the share of that gap
LEAST = 1.0  # mm by which a blink must close a place, at the least, to be measured there
_SIDES = ("Left", "Right")


class LidLimits:
    """The limits of one head's lids, whose vertices (28, 3) are at `rest` and are displaced by `moved`.

    `moved` (52, 28, 3) mm at weight 1; `free` (52,): the shapes that the fit may use.
    """

    def __init__(self, moved: Array, rest: Array, free: BoolArray) -> None:
        self._free = [bool(free[INDEX[f"eyeBlink{side}"]]) for side in _SIDES]
        self._rest, self._moved = _gap(rest[None])[0], _gap(moved)
        closing = [self._moved[INDEX[f"eyeBlink{side}"], eye] for eye, side in enumerate(_SIDES)]
        self._closing = np.maximum(-np.array(closing), LEAST)

    def keep(self, weights: Array, points: Array) -> None:
        """Change the weights (n, 52) of some faces in place; `points` (n, 28, 3) mm are their lids."""
        gap = _gap(points)
        found = self._rest + (weights @ self._moved.reshape(len(self._moved), -1)).reshape(gap.shape)
        over = (found - gap - WIDER - OPEN * np.maximum(gap, 0.0)) / self._closing
        more = np.maximum(over.max(axis=-1), 0.0)
        for eye, side in enumerate(_SIDES):
            if self._free[eye]:
                shut, wide = INDEX[f"eyeBlink{side}"], INDEX[f"eyeWide{side}"]
                blink = weights[:, shut] - weights[:, wide] + more[:, eye]
                weights[:, shut] = np.where(more[:, eye] > 0.0, np.maximum(blink, 0.0), weights[:, shut])
                weights[:, wide] = np.where(more[:, eye] > 0.0, np.maximum(-blink, 0.0), weights[:, wide])


def lid_vertices(head: Head, rest: Array) -> Int32Array:
    """Return the level-1 vertices (2, 7, 2) of the left and the right eye: of the upper and the lower lid."""
    return np.array([_widest(pairs, rest) for pairs in head.lid_pairs], np.int32)


def _widest(pairs: Int32Array, rest: Array) -> Int32Array:
    """Return the pairs (7, 2) of the upper and the lower lid that are widest apart."""
    apart = rest[pairs[:, 0], 1] - rest[pairs[:, 1], 1]
    upwards = np.where(apart[:, None] > 0.0, pairs, pairs[:, ::-1])
    return np.asarray(upwards[np.argsort(-np.abs(apart), kind="stable")[:PLACES]])


def _gap(points: Array) -> Array:
    """Return the gaps (n, 2, 7) in mm along y between the lids' vertices (n, 28, 3)."""
    height = points[..., 1].reshape(len(points), 2, PLACES, 2)
    return np.asarray(height[..., 0] - height[..., 1])
