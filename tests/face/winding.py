"""Which points lie inside the flesh, by generalized winding numbers (Jacobson et al. 2013)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba as nb
import numpy as np

MOUTH_REACH = 55.0
LIP_REACH = 7.0
LIFT = 0.02
APEX = (0.0, -60.0, -120.0)


@dataclass(frozen=True, repr=False)
class LipTester:
    """Measures how deep the lips of a skin (N1, 3) lie in one another, on the closed mouth."""

    triangles: np.ndarray
    upper: np.ndarray
    lower: np.ndarray
    upper_faces: np.ndarray
    lower_faces: np.ndarray

    @classmethod
    def of(cls, head):
        skin = head.skin.matrix @ head.rest
        above = head.skin.matrix @ head.jaw_weight < 0.5
        red = head.skin.matrix @ np.maximum(head.masks["lips"], head.masks["inner_mouth"]) > 0.3
        meeting = head.rest[head.lip_pairs].mean(axis=1)
        apart = np.linalg.norm(skin[:, None] - meeting[None, ::3], axis=2).min(axis=1)
        corner = np.abs(meeting[:, 0]).max() - 0.8
        lip = red & (apart < LIP_REACH) & (np.abs(skin[:, 0]) < corner)
        near = np.linalg.norm(skin - meeting.mean(axis=0), axis=1) < MOUTH_REACH
        bag = head.skin.matrix @ head.masks["inner_mouth"] > 0.1
        faces = head.skin.triangles
        mouth = faces[(near | bag)[faces].all(axis=1)]
        return cls(
            closed(mouth, len(skin)),
            np.flatnonzero(lip & above),
            np.flatnonzero(lip & ~above),
            mouth[above[mouth].any(axis=1) & red[mouth].any(axis=1)],
            mouth[~above[mouth].all(axis=1) & red[mouth].any(axis=1)],
        )

    def overlap(self, skin):
        """Greatest depth in mm to which a lip's vertex lies inside the other lip."""
        points = np.vstack([np.asarray(skin, dtype=np.float64), [APEX]])
        raised = points + LIFT * normals(points, self.triangles)
        depth = 0.0
        for lip, other in ((self.upper, self.lower_faces), (self.lower, self.upper_faces)):
            inside = lip[winding_numbers(raised[lip], points, self.triangles) > 0.5]
            if len(inside):
                depth = max(depth, float(distances(inside, raised, points, other).max()) + LIFT)
        return depth


@nb.njit(cache=True, parallel=True)
def winding_numbers(points, vertices, triangles):
    """Winding number (n,) of `points` (n, 3) about the closed mesh; 1 inside, 0 outside."""
    result = np.zeros(len(points))
    for i in nb.prange(len(points)):
        x, y, z = points[i, 0], points[i, 1], points[i, 2]
        total = 0.0
        for t in range(len(triangles)):
            a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
            ax, ay, az = vertices[a, 0] - x, vertices[a, 1] - y, vertices[a, 2] - z
            bx, by, bz = vertices[b, 0] - x, vertices[b, 1] - y, vertices[b, 2] - z
            cx, cy, cz = vertices[c, 0] - x, vertices[c, 1] - y, vertices[c, 2] - z
            la = math.sqrt(ax * ax + ay * ay + az * az)
            lb = math.sqrt(bx * bx + by * by + bz * bz)
            lc = math.sqrt(cx * cx + cy * cy + cz * cz)
            volume = ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
            ab, bc, ca = ax * bx + ay * by + az * bz, bx * cx + by * cy + bz * cz, cx * ax + cy * ay + cz * az
            total += math.atan2(volume, la * lb * lc + ab * lc + bc * la + ca * lb)
        result[i] = total / (2.0 * math.pi)
    return result


@nb.njit(cache=True)
def distances(which, points, vertices, triangles):
    """Distance (n,) from vertices `which` (n,) to the nearest triangle that they are not part of."""
    result = np.full(len(which), np.inf)
    for i in range(len(which)):
        point = points[which[i]]
        for t in range(len(triangles)):
            a, b, c = triangles[t]
            if which[i] != a and which[i] != b and which[i] != c:
                away = point - nearest(point, vertices[a], vertices[b], vertices[c])
                result[i] = min(result[i], np.sqrt((away**2).sum()))
    return result


@nb.njit(cache=True)
def nearest(p, a, b, c):
    """The point of triangle a b c nearest to p (Ericson 2005, section 5.1.5)."""
    ab, ac, ap = b - a, c - a, p - a
    d1, d2 = np.dot(ab, ap), np.dot(ac, ap)
    if d1 <= 0.0 and d2 <= 0.0:
        return a
    d3, d4 = np.dot(ab, p - b), np.dot(ac, p - b)
    if d3 >= 0.0 and d4 <= d3:
        return b
    vc = d1 * d4 - d3 * d2
    if vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        return a + ab * (d1 / (d1 - d3))
    d5, d6 = np.dot(ab, p - c), np.dot(ac, p - c)
    if d6 >= 0.0 and d5 <= d6:
        return c
    vb = d5 * d2 - d1 * d6
    if vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        return a + ac * (d2 / (d2 - d6))
    va = d3 * d6 - d5 * d4
    if va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)))
    total = va + vb + vc
    return a + ab * (vb / total) + ac * (vc / total)


def closed(triangles, apex):
    """Close the holes of a mesh with a fan about the vertex `apex`."""
    sides = np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    paired = {(a, b) for a, b in sides.tolist()}
    border = [(b, a, apex) for a, b in sides.tolist() if (b, a) not in paired]
    return np.vstack([triangles, np.array(border, dtype=np.int32)]).astype(np.int32)


def normals(vertices, triangles):
    """Unit normals (n, 3) of the vertices."""
    a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
    faces = np.cross(b - a, c - a)
    result = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(result, triangles[:, corner], faces)
    return result / np.maximum(np.linalg.norm(result, axis=1, keepdims=True), 1e-12)
