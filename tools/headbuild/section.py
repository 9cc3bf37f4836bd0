"""Sections of the mouth: where upper and lower lip stand above each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from risorius.core.arrays import AnyArray
from risorius.face.numerics.subdivide import Subdivision

_STEP = 0.2  # mm between samples along z
_FRONT, _TIP = 12.0, 50.0  # z in mm between which lips are looked for


@dataclass(frozen=True)
class MouthSections:
    """Measures the gap between the lips on level 1, in planes of constant x.

    `upper` and `lower` are the level-1 triangles (n, 3) of either lip; `depths` (k,) are the z at which it
    looks.
    """

    skin: Subdivision
    upper: AnyArray
    lower: AnyArray
    depths: AnyArray

    @classmethod
    def of(cls, skin: Subdivision, sides: AnyArray, forward: float = 0.0) -> MouthSections:
        """Take the triangles of the lips, told apart by `sides` (N0,): 1 upper, -1 lower, 0 elsewhere; they
        stand `forward` mm before their place on the template.
        """
        side = (skin.matrix @ sides)[skin.triangles].mean(axis=1)
        depths = np.arange(_FRONT, _TIP, _STEP) + forward
        return cls(skin, skin.triangles[side > 0.5], skin.triangles[side < -0.5], depths)

    def gap(self, points: AnyArray, x: float) -> float:
        """Least height in mm of the upper lip above the lower one at `x`; negative where they overlap, inf
        beyond.
        """
        _, above, below = self._profiles(points, x)
        return float((above - below).min()) if len(above) else np.inf

    def meeting(self, points: AnyArray, x: float) -> AnyArray:
        """The point (3,) midway between the lips where they come nearest, at `x`."""
        z, above, below = self._profiles(points, x)
        nearest = int(np.argmin(above - below))
        return np.array([x, (above[nearest] + below[nearest]) / 2.0, z[nearest]])

    def crest(self, points: AnyArray, x: float) -> AnyArray:
        """The highest point (3,) of the lower lip at `x`."""
        z = self.depths
        below = _envelope(self.skin.matrix @ points, self.lower, x, z)
        highest = int(np.argmax(below))
        return np.array([x, below[highest], z[highest]])

    def _profiles(self, points: AnyArray, x: float) -> tuple[AnyArray, AnyArray, AnyArray]:
        """z (k,) where both lips stand at `x`, the upper lip's lower side and the lower lip's upper side
        there.
        """
        fine = self.skin.matrix @ points
        z = self.depths
        above = -_envelope(fine * np.array([1.0, -1.0, 1.0]), self.upper, x, z)
        below = _envelope(fine, self.lower, x, z)
        both = np.isfinite(above) & np.isfinite(below)
        return z[both], above[both], below[both]


def _envelope(points: AnyArray, triangles: AnyArray, x: float, z: AnyArray) -> AnyArray:
    """Greatest y at each of `z` of the section of the triangles with the plane at `x`; -inf where there is
    none.
    """
    top = np.full(len(z), -np.inf)
    for a, b in _cut(points, triangles, x):
        (near, far) = (a, b) if a[2] <= b[2] else (b, a)
        inside = (z >= near[2]) & (z <= far[2])
        share = (z[inside] - near[2]) / max(far[2] - near[2], 1e-9)
        top[inside] = np.maximum(top[inside], near[1] + share * (far[1] - near[1]))
    return top


def _cut(points: AnyArray, triangles: AnyArray, x: float) -> AnyArray:
    """Segments (n, 2, 3) in which the plane at `x` cuts the triangles."""
    side = points[:, 0] - x
    positive = side[triangles] > 0.0
    crossing = triangles[(positive.sum(axis=1) % 3) > 0]
    lone = _lone_corner(side[crossing] > 0.0)
    rows = np.arange(len(crossing))
    tip, left, right = (crossing[rows, (lone + k) % 3] for k in range(3))
    ends = []
    for other in (left, right):
        share = (side[tip] / (side[tip] - side[other]))[:, None]
        ends.append(points[tip] + share * (points[other] - points[tip]))
    return np.stack(ends, axis=1)


def _lone_corner(positive: AnyArray) -> AnyArray:
    """Index (n,) of the corner that stands alone on its side of the plane."""
    return np.asarray(np.argmax(positive == (positive.sum(axis=1) == 1)[:, None], axis=1))
