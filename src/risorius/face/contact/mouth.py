"""The places at which lips can touch: their surfaces, the line on which they meet, the upper teeth's edge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.spatial import cKDTree

from ...core.arrays import Array, BoolArray, IndexArray, Int32Array
from ..head.head import Head, TeethMesh
from ..muscles.jaw import Jaw
from .contact import Contacts, Facing, find_contacts

REACH = 5.0  # mm from the line on which the lips meet to the farthest point that may touch
STATIONS = 19  # places along that line; the mesh cannot bend more finely
OPENINGS = np.linspace(0.02, 1.0, 50)  # of the jaw, which alone never brings lips together
OVERLAP = 0.03  # mm by which the lips may overlap: less than the mesh's own facets


@dataclass(frozen=True, slots=True)
class Mouth:
    """The part of the skin on which lips touch, at level 1.

    `vertices` (n,): its level-1 vertices; `matrix` (n, N0): computes them from level-0 positions; `facing`:
    its two surfaces; `line` (s, n): at each station from the right corner to the left, the upper minus the
    lower of the two points that meet.
    """

    vertices: IndexArray
    matrix: sp.csr_matrix
    facing: Facing
    line: Array

    @classmethod
    def of(cls, head: Head, jaw: Jaw | None = None) -> Mouth:
        """Find the two surfaces around the lip pairs of `head`, and the line on which they meet at rest.

        `jaw`: the head's, if it exists already.
        """
        meeting = head.rest[head.lip_pairs].mean(axis=1)
        inside = head.skin.matrix @ np.maximum(head.masks["lips"], head.masks["inner_mouth"]) > 0.3
        near = cKDTree(meeting).query(head.skin.matrix @ head.rest)[0] < REACH
        patch = np.flatnonzero(inside & near)
        matrix: sp.csr_matrix = head.skin.matrix[patch].tocsr()
        points = matrix @ head.rest
        above = matrix @ head.jaw_weight < 0.5
        facing = _without_overlap(_facing(patch, head.skin.triangles, above), points)
        jaw, still, carried = jaw or Jaw.of(head), np.zeros_like(head.rest), np.empty_like(head.rest)
        for opening in OPENINGS:
            jaw.carry_skin(head.rest, still, opening, carried)
            facing = _without_overlap(facing, matrix @ carried)
        half = float(np.abs(meeting[:, 0]).max())
        line = _line(facing, above, points, np.linspace(-half, half, STATIONS))
        return cls(patch, matrix, facing, line)

    def lip(self, upper: bool) -> IndexArray:
        """Return the level-1 vertices (k,) of the upper or of the lower lip that may touch the other."""
        return np.asarray(self.vertices[self.facing.vertices[self.facing.above == upper]])


def _facing(patch: IndexArray, triangles: Int32Array, above: BoolArray) -> Facing:
    local = np.full(int(triangles.max()) + 1, -1, np.int32)
    local[patch] = np.arange(len(patch))
    faces = local[triangles]
    faces = faces[(faces >= 0).all(axis=1)]
    # Triangles that join the lips at the corners belong to both: they close the crease behind the corner.
    upper, lower = faces[above[faces].any(axis=1)], faces[~above[faces].all(axis=1)]
    return Facing(np.arange(len(patch), dtype=np.int32), above, upper, lower)


def _without_overlap(facing: Facing, points: Array) -> Facing:
    """Leave out vertices that overlap although they are not lips: folds of the cheek, the crease at a corner.

    Contact must not change the face at rest, nor one that the jaw alone has opened.
    """
    contacts = Contacts.allocate(len(facing.vertices))
    count = find_contacts(facing, points, -OVERLAP, contacts)
    free = ~np.isin(facing.vertices, contacts.points[:count, 0])
    return facing._replace(vertices=facing.vertices[free], above=facing.above[free])


def _line(facing: Facing, above: BoolArray, points: Array, stations: Array) -> Array:
    """Return rows (s, n): around each station (s,) mm in x, the contact with the least gap at rest.

    `above` (n,): which points belong to the upper lip.
    """
    upper, lower = above[facing.upper].all(axis=1), above[facing.lower].any(axis=1)
    facing = facing._replace(upper=facing.upper[upper], lower=facing.lower[~lower])
    contacts = Contacts.allocate(len(facing.vertices))
    count = find_contacts(facing, points, np.inf, contacts)
    width = stations[1] - stations[0]
    rows = np.zeros((len(stations), len(points)))
    for row, x in zip(rows, stations, strict=True):
        best = int(np.argmin(contacts.gap[:count] + np.abs(contacts.x[:count] - x) / width))
        np.add.at(row, contacts.points[best], contacts.weight[best])
    return rows


@dataclass(frozen=True, slots=True)
class TeethEdge:
    """The front teeth's lower edge as a curve: at `x` (k,) ascending, its `y` and `z` (k,), all mm."""

    x: Array
    y: Array
    z: Array

    @classmethod
    def of(cls, teeth: TeethMesh, half_width: float, steps: int) -> TeethEdge:
        """Find the edge of the upper `teeth` over |x| ≤ `half_width` mm, smoothed over their gaps."""
        crowns = teeth.vertices[teeth.material < 0.5]
        x = np.linspace(-half_width, half_width, steps)
        width = x[1] - x[0]
        lowest = np.array([_lowest(crowns[np.abs(crowns[:, 0] - at) <= width]) for at in x])
        y = np.polynomial.Polynomial.fit(x, lowest[:, 1], 2)(x)
        z = np.polynomial.Polynomial.fit(x, lowest[:, 2], 2)(x)
        return cls(x, y, z)

    def at(self, x: Array) -> tuple[Array, Array]:
        """Return y and z (n,) of the edge at `x` (n,)."""
        return np.interp(x, self.x, self.y), np.interp(x, self.x, self.z)


def _lowest(crowns: Array) -> Array:
    return np.asarray(crowns[np.argmin(crowns[:, 1])])
