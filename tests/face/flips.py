"""Faces of the skin that are folded over."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from risorius.face.contact.lids import FRONT

MOUTH_LINING = 0.2  # of the inner mouth's mask, above which skin is not seen
SOCKET = 4.0  # mm from an eyeball, behind its front: skin that lines the socket and is not seen
SMALLEST = 0.05  # mm² of the smallest face that counts: about one pixel of a close-up 1080 pixels high


def visible(head):
    """Which level-1 vertices (N1,) are seen: not the inner mouth, nor what lines the eyes' sockets."""
    rest = head.skin.matrix @ head.rest
    seen = np.asarray(head.skin.matrix @ head.masks["inner_mouth"] < MOUTH_LINING)
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        ahead = rest - centre
        seen &= (np.linalg.norm(ahead, axis=1) > radius + SOCKET) | (ahead[:, 2] > FRONT * radius)
    return seen


def normals(skin, quads):
    """Normals (q, 3) of faces, as long as twice their areas."""
    a, b, c, d = (skin[quads[:, k]].astype(np.float64) for k in range(4))
    return np.asarray(np.cross(c - a, d - b))


class Flips:
    """Counts faces that are folded over: they look the other way than the faces about them, and than they
    would had they only turned with the skin about them. The second tells a fold from a crease of the rest.
    """

    def __init__(self, head):
        self.quads = head.skin.quads
        self.seen = visible(head)[self.quads].all(axis=1)
        self._rest = head.skin.matrix @ head.rest
        self._normals = normals(self._rest, self.quads)
        rows = np.repeat(np.arange(len(self.quads)), 4)
        corners = sp.csr_matrix((np.ones(len(rows)), (rows, self.quads.ravel())))
        self._around = ((corners @ corners.T) > 0).astype(np.float64)

    def count(self, skin):
        """How many visible faces of `skin` (N1, 3) are flipped."""
        return len(self.find(skin))

    def find(self, skin):
        """The visible faces of `skin` (N1, 3) that are flipped, but for slivers."""
        found, areas = self.with_areas(skin)
        return found[areas > SMALLEST]

    def with_areas(self, skin):
        """The visible faces of `skin` (N1, 3) that are flipped, slivers too, and their areas in mm²."""
        own = normals(skin, self.quads)
        against = ((own * (self._around @ own)).sum(axis=1) < 0.0) & self.seen
        flipped = [q for q in np.flatnonzero(against) if self._carried(skin, q) @ own[q] < 0.0]
        found = np.array(flipped, np.intp)
        return found, 0.5 * np.linalg.norm(own[found], axis=1)

    def _carried(self, skin, quad):
        """Normal (3,) of a face at rest, turned as the skin about it has turned (Kabsch)."""
        about = np.unique(self.quads[(self._around[quad] @ self._around).indices])
        before, now = (p[about].astype(np.float64) - p[about].mean(axis=0) for p in (self._rest, skin))
        u, _, vt = np.linalg.svd(before.T @ now)
        u[:, 2] *= np.linalg.det(u @ vt)
        return self._normals[quad] @ u @ vt
