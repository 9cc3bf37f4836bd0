"""The edges of the mesh that a wireframe shows, and their strengths."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Float32Array
from ..face.head.head import Head

_FINE = 0.28  # strength of the edges that subdivision added


def edge_strengths(head: Head, triangles: int) -> Float32Array:
    """Return the strengths (m, 3) float32, 0..1, of the edges opposite to each corner of a scene's triangles.

    Edges of the skin's coarse quads have strength 1, those that subdivision added less, diagonals 0.
    """
    strengths = np.zeros((triangles, 3), np.float32)
    faces = head.skin.triangles
    count, coarse = len(head.rest), head.skin.matrix.shape[0] - len(head.quads)
    # Each fine quad runs vertex, edge, face, edge; its two triangles share the diagonal vertex–face.
    vertex, face = faces < count, faces >= coarse
    for corner in range(3):
        one, other = (corner + 1) % 3, (corner + 2) % 3
        diagonal = (vertex[:, one] & face[:, other]) | (face[:, one] & vertex[:, other])
        outer = vertex[:, one] | vertex[:, other]
        strengths[: len(faces), corner] = np.where(diagonal, 0.0, np.where(outer, 1.0, _FINE))
    return strengths
