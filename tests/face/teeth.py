"""How deep teeth, lips and tongue lie in one another, in mm."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from .winding import APEX, LipTester, distances, winding_numbers

NEAR = 3.0  # mm: what is further from a surface does not pierce it
IN_GUM = 0.4  # winding number about the open gum; the floor of the mouth's vestibule passes through the necks


class TeethTester:
    """Measures one head: the front teeth against lips and cheeks, and the tongue against the teeth."""

    def __init__(self, head):
        self._upper, self._lower = head.teeth_upper, head.teeth_lower
        self._crowns = [_closed_crowns(mesh) for mesh in (self._upper, self._lower)]
        self._mouth = LipTester.of(head).triangles
        self._used = np.unique(self._mouth[self._mouth < len(head.skin.matrix.indptr) - 1])

    def in_lips(self, frame):
        """Greatest depth of a crown's vertex in the flesh of lips and cheeks."""
        skin = np.vstack([frame.skin.astype(np.float64), [APEX]])
        crowns = [np.asarray(m, np.float64)[np.unique(t)] for m, t in self._placed(frame)]
        points = np.vstack(crowns)
        return _depth(points, skin, self._mouth, self._used)

    def lips_in(self, frame):
        """Greatest depth of the lips' skin in a tooth."""
        return max(self._in_teeth(frame.skin[self._used].astype(np.float64), frame))

    def tongue_in(self, frame):
        """Greatest depth of the tongue in the upper teeth and in the lower ones."""
        return self._in_teeth(frame.tongue.astype(np.float64), frame)

    def _in_teeth(self, points, frame):
        return [_depth(points, np.asarray(m, np.float64), t, np.unique(t)) for m, t in self._placed(frame)]

    def _placed(self, frame):
        """Vertices and closed triangles of the crowns of either jaw."""
        for vertices, (centres, triangles) in zip(
            (self._upper.vertices, frame.teeth_lower), self._crowns, strict=True
        ):
            ends = [vertices[ring].mean(axis=0) for ring in centres]
            yield np.vstack([vertices, ends]), triangles


def _depth(points, vertices, triangles, used):
    """Greatest distance from the surface of those `points` (n, 3) that lie inside the closed mesh."""
    near = points[cKDTree(vertices[used]).query(points, distance_upper_bound=NEAR)[0] < NEAR]
    if not len(near):
        return 0.0
    inside = near[winding_numbers(near, vertices, triangles) > 0.5]
    if not len(inside):
        return 0.0
    rows = len(vertices) + np.arange(len(inside))  # none of them is a corner of a triangle
    return float(distances(rows, np.vstack([vertices, inside]), vertices, triangles).max())


def _closed_crowns(mesh):
    """The rings where crowns leave the gum, and the triangles of what stands out, closed there by fans."""
    gum = mesh.triangles[(mesh.material[mesh.triangles] > 0.5).all(axis=1)]
    out = (mesh.material < 0.5) & (winding_numbers(mesh.vertices, mesh.vertices, gum) < IN_GUM)
    tooth = mesh.triangles[out[mesh.triangles].all(axis=1)]
    sides = np.vstack([tooth[:, [0, 1]], tooth[:, [1, 2]], tooth[:, [2, 0]]]).tolist()
    paired = {(a, b) for a, b in sides}
    follows = {b: a for a, b in sides if (b, a) not in paired}
    rings, fans = [], []
    while follows:
        ring = [next(iter(follows))]
        while ring[-1] in follows:
            ring.append(follows.pop(ring[-1]))
        ring.pop()
        end = len(mesh.vertices) + len(rings)
        fans += [[a, b, end] for a, b in zip(ring, ring[1:] + ring[:1], strict=True)]
        rings.append(ring)
    return rings, np.vstack([tooth, np.array(fans, tooth.dtype)]).astype(np.int32)
