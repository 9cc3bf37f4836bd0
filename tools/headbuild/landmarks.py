"""The 68 iBUG points on the level-1 skin, numbered from the subject's right (the left of the image)."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from risorius.core.arrays import AnyArray

from .bust import Bust
from .lids import lid_pairs, margin
from .mouth import VERMILION, LipSeal
from .pack import NOISE

# The middle line of the left brow as it is drawn: |x| and y in mm, from the inner to the outer end.
BROW = np.array([[10.5, 18.4], [19.5, 21.2], [29.0, 23.2], [38.5, 23.6], [48.5, 21.8]])
_CHIN_FORWARD = 0.6
_THROAT = -120.0  # y in mm below which no chin is looked for
_MIRROR = np.array([-1.0, 1.0, 1.0])


INNER_LIPS = slice(60, 68)


def landmarks(bust: Bust, rest: AnyArray, seal: LipSeal) -> tuple[AnyArray, AnyArray]:
    """Level-1 vertices (68, 3) and barycentric weights (68, 3) of the points on the template's skin at
    rest.
    """
    surface = Surface(seal.sections.skin.matrix @ rest, seal.sections.skin.triangles)
    jaw, brow, nose = _jaw(bust, rest), _brow(surface), _nose(rest, surface)
    eye, outer = _eye(bust, rest), _outer_lips(bust, rest, seal)
    points = np.vstack([_both(jaw[::-1], jaw[1:]), brow[::-1] * _MIRROR, brow, nose])
    points = np.vstack([points, eye[[3, 2, 1, 0, 5, 4]] * _MIRROR, eye, outer])
    triangles, weights = surface.project(points)
    inner_triangles, inner_weights = inner_lips(rest, seal)
    return np.vstack([triangles, inner_triangles]), np.vstack([weights, inner_weights])


def inner_lips(rest: AnyArray, seal: LipSeal) -> tuple[AnyArray, AnyArray]:
    """The points 60 to 67 (8, 3) on any head: they depend on where its lips meet."""
    surface = Surface(seal.sections.skin.matrix @ rest, seal.sections.skin.triangles)
    found = [_inner_lips(rest, seal, surface, side) for side in ("upper", "lower")]
    return np.vstack([t for t, _ in found]), np.vstack([w for _, w in found])


class Surface:
    """A triangle mesh on which the nearest point to a given one is found."""

    def __init__(self, points: AnyArray, triangles: AnyArray) -> None:
        """Take vertices (n, 3) and triangles (m, 3)."""
        self.points, self.triangles = points, triangles
        self._tree = cKDTree(points[triangles].mean(axis=1))

    def project(self, wanted: AnyArray, among: AnyArray | None = None) -> tuple[AnyArray, AnyArray]:
        """Triangle (k, 3) and barycentric weights (k, 3) nearest to each of `wanted` (k, 3), of all or
        `among`.
        """
        pool = self.triangles if among is None else among
        tree = self._tree if among is None else cKDTree(self.points[among].mean(axis=1))
        found = [self._nearest(point, pool[tree.query(point, k=min(24, len(pool)))[1]]) for point in wanted]
        return np.array([t for t, _ in found]), np.array([w for _, w in found])

    def front(self, x: float, y: float) -> AnyArray:
        """The foremost point (3,) of the surface at `x` and `y`."""
        corners = self.points[self.triangles]
        edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        offset = np.array([x, y]) - corners[:, 0, :2]
        area = edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]
        area = np.where(np.abs(area) < 1e-12, np.nan, area)
        u = (offset[:, 0] * edge2[:, 1] - offset[:, 1] * edge2[:, 0]) / area
        v = (edge1[:, 0] * offset[:, 1] - edge1[:, 1] * offset[:, 0]) / area
        hit = (u >= 0) & (v >= 0) & (u + v <= 1)
        z = corners[hit, 0, 2] + u[hit] * edge1[hit, 2] + v[hit] * edge2[hit, 2]
        return np.array([x, y, float(z.max())])

    def _nearest(self, point: AnyArray, candidates: AnyArray) -> tuple[AnyArray, AnyArray]:
        """Return the triangle and the weights; of equally near ones, the first by its vertices."""
        nearest = [(t, _closest_weights(self.points[t], point)) for t in candidates]

        def order(item: tuple[AnyArray, AnyArray]) -> tuple[float, tuple[int, ...]]:
            distance = float(np.linalg.norm(item[1] @ self.points[item[0]] - point))
            return round(distance / NOISE) * NOISE, tuple(map(int, item[0]))

        return min(nearest, key=order)


def _closest_weights(corners: AnyArray, point: AnyArray) -> AnyArray:
    """Barycentric weights (3,) of the point of a triangle (3, 3) nearest to `point`."""
    edges = np.stack([corners[1] - corners[0], corners[2] - corners[0]], axis=1)
    inside = np.linalg.lstsq(edges, point - corners[0], rcond=None)[0]
    best = np.array([1.0 - inside.sum(), *inside])
    if best.min() >= 0.0:
        return best
    options = []
    for a, b in ((0, 1), (1, 2), (2, 0)):
        edge = corners[b] - corners[a]
        t = float(np.clip((point - corners[a]) @ edge / max(float(edge @ edge), 1e-12), 0.0, 1.0))
        weights = np.zeros(3)
        weights[[a, b]] = 1.0 - t, t
        options.append(weights)
    return min(options, key=lambda w: float(np.linalg.norm(w @ corners - point)))


def _both(right_to_middle: AnyArray, left: AnyArray) -> AnyArray:
    return np.vstack([right_to_middle * _MIRROR, left])


def _jaw(bust: Bust, rest: AnyArray) -> AnyArray:
    """(9, 3) from the chin's lowest point up the left outline of the face, as seen from the front, to the
    ear.
    """
    ears = bust.texture("ears")
    neck = np.interp(rest[:, 1], [-115.0, -20.0], [-12.0, -58.0])
    middle = rest[(np.abs(rest[:, 0]) < 0.5) & (rest[:, 2] > 5.0)]
    # The chin's edge as seen a little from below: farther back the point would hardly drop with the jaw.
    depth = middle[:, 1] - _CHIN_FORWARD * middle[:, 2]
    chin = middle[np.argmin(np.where(middle[:, 1] > _THROAT, depth, np.inf))]
    face = (ears < 0.1) & (rest[:, 2] > neck) & (rest[:, 0] > -1e-6) & (rest[:, 1] > chin[1])
    points = rest[face]
    levels = np.linspace(chin[1] + 0.5, 3.0, 160)
    outline = [chin]
    for level in levels:
        near = points[np.abs(points[:, 1] - level) < 4.0]
        if len(near):
            outline.append(near[np.argmax(near[:, 0])])
    line = np.array(outline)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line[:, :2], axis=0), axis=1))])
    at = np.linspace(0.0, length[-1], 9)
    return np.stack([np.interp(at, length, line[:, k]) for k in range(3)], axis=1)


def _brow(surface: Surface) -> AnyArray:
    """(5, 3) along the left brow, from its inner to its outer end."""
    return np.array([surface.front(x, y) for x, y in BROW])


def _nose(rest: AnyArray, surface: Surface) -> AnyArray:
    """(9, 3): four down the bridge to the tip, five along the nostrils from the right to the left."""
    middle = rest[(np.abs(rest[:, 0]) < 0.5) & (rest[:, 2] > 15.0) & (rest[:, 1] > -50.0)]
    tip = middle[np.argmax(np.where(middle[:, 1] < -15.0, middle[:, 2], -np.inf))]
    bridge = [surface.front(0.01, y) for y in np.linspace(0.0, tip[1], 4)]
    below = np.array([surface.front(0.01, y) for y in tip[1] - np.linspace(3.0, 18.0, 61)])
    base = below[np.argmin(below[:, 2])]
    wings = [
        surface.front(x, base[1] + rise) for x, rise in ((-11.0, 2.5), (-5.5, 0.5), (5.5, 0.5), (11.0, 2.5))
    ]
    return np.array([*bridge, *wings[:2], base, *wings[2:]])


def _eye(bust: Bust, rest: AnyArray) -> AnyArray:
    """(6, 3) of the left eye: inner corner, two on the upper lid, outer corner, two on the lower lid."""
    ring = rest[margin(bust)]
    inner, outer = ring[np.argmin(ring[:, 0])], ring[np.argmax(ring[:, 0])]
    pairs = rest[lid_pairs(bust, "left")]
    thirds = inner[0] + (outer[0] - inner[0]) * np.array([1.0, 2.0]) / 3.0
    upper, lower = (_at_x(pairs[:, k], thirds) for k in (0, 1))
    return np.vstack([inner, upper, outer, lower[::-1]])


def _outer_lips(bust: Bust, rest: AnyArray, seal: LipSeal) -> AnyArray:
    """(12, 3) along the border of the lips' red: right corner, upper lip, left corner, lower lip back to
    the right.
    """
    ring = np.array(bust.loop(*VERMILION))
    corner = rest[seal.corner]
    upper = rest[ring[rest[ring, 1] > corner[1]]]
    lower = rest[ring[rest[ring, 1] <= corner[1]]]
    across = corner[0] * np.array([-0.62, -0.16, 0.0, 0.16, 0.62])
    back = corner[0] * np.array([0.60, 0.28, 0.0, -0.28, -0.60])
    return np.vstack([corner * _MIRROR, _at_x(upper, across), corner, _at_x(lower, back)])


def _inner_lips(rest: AnyArray, seal: LipSeal, surface: Surface, side: str) -> tuple[AnyArray, AnyArray]:
    """Four points on a lip where the two meet: upper 60 to 63 (from the right corner), lower 64 to 67
    (from the left).
    """
    corner = rest[seal.corner]
    across = corner[0] * np.array([-0.96, -0.4, 0.0, 0.4]) * (1.0 if side == "upper" else -1.0)
    wanted = np.array([seal.line(rest, float(x) + 0.01) for x in across])
    return surface.project(wanted, seal.sections.upper if side == "upper" else seal.sections.lower)


def _at_x(line: AnyArray, x: AnyArray) -> AnyArray:
    """Points (k, 3) at `x` on a line of points (n, 3)."""
    ordered = line[np.argsort(line[:, 0], kind="stable")]
    return np.stack([np.interp(x, ordered[:, 0], ordered[:, k]) for k in range(3)], axis=1)
