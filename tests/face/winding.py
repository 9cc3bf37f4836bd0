"""Which points lie inside the flesh, by generalized winding numbers (Jacobson et al. 2013)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numba as nb
import numpy as np

MOUTH_REACH = 55.0
LIP_REACH = 7.0
LIFT = 0.02
HUGE = 1e100
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


def winding_numbers(points, vertices, triangles):
    """Winding number (n,) of `points` (n, 3) about the closed mesh; 1 inside, 0 outside."""
    used, corners = np.unique(triangles, return_inverse=True)
    return _winding_numbers(points, vertices[used], corners.reshape(-1, 3).astype(np.int32))


@nb.njit(cache=True, parallel=True)
def _winding_numbers(points, vertices, triangles):
    """Half the solid angle of a triangle is that of a complex number; those of all are multiplied, and
    the times counted that the product passes the negative axis: far quicker than as many arctangents.
    """
    result = np.zeros(len(points))
    for i in nb.prange(len(points)):
        arm, length = np.empty((len(vertices), 3)), np.empty(len(vertices))
        for v in range(len(vertices)):
            x, y, z = (
                vertices[v, 0] - points[i, 0],
                vertices[v, 1] - points[i, 1],
                vertices[v, 2] - points[i, 2],
            )
            arm[v, 0], arm[v, 1], arm[v, 2], length[v] = x, y, z, math.sqrt(x * x + y * y + z * z)
        real, imaginary, turns = 1.0, 0.0, 0
        for t in range(len(triangles)):
            a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
            ax, ay, az, la = arm[a, 0], arm[a, 1], arm[a, 2], length[a]
            bx, by, bz, lb = arm[b, 0], arm[b, 1], arm[b, 2], length[b]
            cx, cy, cz, lc = arm[c, 0], arm[c, 1], arm[c, 2], length[c]
            volume = ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
            ab, bc, ca = ax * bx + ay * by + az * bz, bx * cx + by * cy + bz * cz, cx * ax + cy * ay + cz * az
            plain = la * lb * lc + ab * lc + bc * la + ca * lb
            before, real, imaginary = (
                imaginary,
                real * plain - imaginary * volume,
                real * volume + imaginary * plain,
            )
            if before >= 0.0 and volume >= 0.0:
                turns += imaginary < 0.0
            elif before < 0.0 and volume < 0.0:
                turns -= imaginary >= 0.0
            size = abs(real) + abs(imaginary)
            if size > HUGE or size < 1.0 / HUGE:
                real, imaginary = real / size, imaginary / size
        result[i] = turns + math.atan2(imaginary, real) / (2.0 * math.pi)
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
