"""The lips' contact as limits of a fit of shapes: where a face's lips touch, so do those that weights move.

The 52 shapes are fitted to the skin, of which the lips are a small part; then only those that form the mouth
change, as little as that skin allows, until the gap between the lips is within its limits at 19 places from
corner to corner. The limits follow the face's own gap, so nothing switches when a seal begins, and they are
stiff while the lips are nearly shut; over an open mouth they yield to the rest of the face, overlap apart.

A gap is measured twice: along y between the two points that meet at rest, and across the surfaces that face
each other, which differs if one lip slides along the other. Neither may be too wide, the second not negative.
"""

from __future__ import annotations

import numpy as np

from ...core.arkit import INDEX
from ...core.arrays import Array, BoolArray
from ..numerics.soft_limits import within_limits
from .mouth_gap import MouthGap

SHAPES = (
    *("jawOpen", "jawForward", "mouthClose", "mouthRollUpper", "mouthRollLower", "mouthPressLeft"),
    *("mouthPressRight", "mouthShrugUpper", "mouthShrugLower", "mouthLowerDownLeft", "mouthLowerDownRight"),
    *("mouthUpperUpLeft", "mouthUpperUpRight"),
)
"""The shapes that form the mouth: those that may change to keep the lips' contact."""

WIDER, NARROWER, OVERLAP = 0.09, 0.1, 0.15  # mm wider than the face's gap; narrower amid it; below rest
AMID = slice(8, 11)  # the places whose opening is followed both ways
# How stiff limits are, in mm² of the skin's squares for each mm² of a gap, and the widest gap in mm over
# which they are half as stiff.
SHUT_STIFF, SHUT_HALF = 5e5, 0.3  # of a mouth that is nearly shut
OPEN_STIFF, OPEN_HALF = 5e4, 10.0  # of one that is open
OVERLAP_STIFF = 1e5  # of surfaces that overlap
MORE = 0.05  # mm by which they may overlap more than the points that meet at rest
SLIDE = 30.0  # the same for a lip that slides along the other
LEAST = 3e4  # mm²: the squares of shapes that move fewer vertices count as this many
NARROW = 0.2  # mm between two places, at the least, for the slope of the line between the lips


class LipLimits:
    """The limits of one head's gap, for a fit with the normal equations `normal` (52, 52).

    `corners` (52, 19, 4, 3) mm: how the fit's unknowns displace the vertices of the gap, which are at `rest`
    (19, 4, 3) mm; `free` (52,): the shapes that it may use.
    """

    def __init__(self, gap: MouthGap, corners: Array, rest: Array, normal: Array, free: BoolArray) -> None:
        self._gap = gap
        self._moving = np.array([INDEX[name] for name in SHAPES if free[INDEX[name]]], dtype=np.intp)
        self._fixed = ~np.isin(np.arange(len(corners)), self._moving)
        self._ways = gap.between(corners)
        self._rest, self._tilt = gap.between(rest), self._slant(rest)
        own = normal[np.ix_(self._moving, self._moving)].copy()
        own[np.diag_indices(len(own))] = np.maximum(own.diagonal(), LEAST)
        self._own = own
        moving = self._ways[self._moving]
        self._aside = np.ascontiguousarray(moving[:, :, ::2].reshape(len(moving), 2 * moving.shape[1]))
        self._normal = own + SLIDE * self._aside @ self._aside.T
        self._up, self._across = np.ascontiguousarray(moving[:, :, 1].T), moving[:, :, ::2].transpose(1, 2, 0)

    def _slant(self, corners: Array) -> Array:
        """Return dy/dx (..., 19) of the line between the lips; `corners` (..., 19, 4, 3) mm."""
        middle = 0.5 * (np.abs(self._gap.share)[:, :, None] * corners[..., :2]).sum(axis=-2)
        before = np.concatenate((middle[..., :1, :], middle[..., :-1, :]), -2)
        after = np.concatenate((middle[..., 1:, :], middle[..., -1:, :]), -2)
        way = after - before
        return np.asarray(way[..., 1] / np.maximum(way[..., 0], NARROW))

    def keep(self, weights: Array, corners: Array) -> None:
        """Change the weights (n, 52) of some faces in place so that their lips touch as the faces' do.

        `corners` (n, 19, 4, 3) mm: the gap's vertices on the faces.
        """
        if not len(self._moving):
            return
        way = self._gap.between(corners) - self._rest
        others = np.where(self._fixed, weights, 0.0) @ self._ways.reshape(len(self._fixed), -1)
        left = others.reshape(way.shape) - way
        slope = self._gap.slope + np.stack((self._slant(corners) - self._tilt, np.zeros(way.shape[:2])), -1)
        begin = weights[:, self._moving]
        right = begin @ self._own - SLIDE * left[..., ::2].reshape(len(way), -1) @ self._aside.T
        limits = self._limits(way[..., 1], left[..., 1], (slope * left[..., ::2]).sum(-1), slope)
        weights[:, self._moving] = within_limits(self._normal, right, *limits, begin)

    def _limits(self, gap: Array, left: Array, slid: Array, slope: Array) -> tuple[Array, Array, Array]:
        """Return rows (n, 76, s), limits and stiffness (n, 76) of the gap.

        `gap` (n, 19) mm is the face's, `left` what the shapes must make up for, `slid` the part of it that is
        slid away; `slope` (n, 19, 2).
        """
        open_by = np.maximum(gap, 0.0)
        highest = open_by - gap + WIDER
        lowest = -open_by - OVERLAP
        lowest[:, AMID] = np.maximum(lowest[:, AMID], -NARROWER)
        tilted = self._up - (slope[..., None] * self._across).sum(axis=-2)
        up = np.broadcast_to(self._up, tilted.shape)
        rows = np.concatenate((up, tilted, -up, -tilted), axis=1)
        across = left - slid
        limit = np.concatenate(
            (highest - left, highest - across, left - lowest, across - lowest + MORE), axis=1
        )
        widest = open_by.max(axis=1, keepdims=True)
        places = gap.shape[1]
        stiff = np.full(limit.shape, OVERLAP_STIFF)
        by_opening = _fall(SHUT_STIFF, widest / SHUT_HALF) + _fall(OPEN_STIFF, widest / OPEN_HALF)
        stiff[:, : 2 * places] = by_opening
        narrower = stiff[:, 2 * places : 3 * places]
        narrower[:] = np.maximum(narrower, by_opening)
        narrower[:, AMID] = by_opening
        return rows, limit, stiff


def _fall(stiff: float, share: Array) -> Array:
    """Return a stiffness that is half as great where a share is 1, and falls with its square."""
    return stiff / (1.0 + share**2)
