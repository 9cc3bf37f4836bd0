"""The normals of a surface, recomputed as its vertices move."""

from __future__ import annotations

from copy import copy

import numpy as np

from ..core.arrays import Float32Array, Int32Array, IntArray
from ..machine.kernels.jit import f4, kernel
from ..machine.kernels.vec import at, cross, sub, unit


@kernel("f4[:, :], i4[:, :], f4[:, :]")
def face_normals(points: Float32Array, faces: Int32Array, out: Float32Array) -> None:
    """Write the normals (m, 3) of `faces` (m, 4), of length twice their area; triangles repeat a corner."""
    for f in range(len(faces)):
        first = sub(at(points, faces[f, 2]), at(points, faces[f, 0]))
        second = sub(at(points, faces[f, 3]), at(points, faces[f, 1]))
        out[f, 0], out[f, 1], out[f, 2] = cross(first, second)


@kernel("f4[:, :], i4[:], i4[:], f4[:, :]")
def vertex_normals(normals: Float32Array, starts: Int32Array, around: Int32Array, out: Float32Array) -> None:
    """Write unit normals (n, 3): at vertex i the sum over the faces `around[starts[i]:starts[i + 1]]`."""
    for i in range(len(starts) - 1):
        x, y, z = f4(0), f4(0), f4(0)
        for k in range(starts[i], starts[i + 1]):
            x += normals[around[k], 0]
            y += normals[around[k], 1]
            z += normals[around[k], 2]
        out[i, 0], out[i, 1], out[i, 2] = unit((x, y, z))


class Normals:
    """Smooth normals of a mesh of fixed faces (m, 4), recomputed as its vertices move."""

    def __init__(self, faces: Int32Array, vertices: int) -> None:
        self._faces = faces
        distinct = np.ones(faces.shape, bool)
        distinct[:, 3] = faces[:, 3] != faces[:, 2]
        corners, owners = faces[distinct], np.nonzero(distinct)[0]
        order = np.argsort(corners, kind="stable")
        self._around: Int32Array = owners[order].astype(np.int32)
        counts = np.bincount(corners, minlength=vertices)
        self._starts: Int32Array = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
        self._face_normals: Float32Array = np.zeros((len(faces), 3), np.float32)

    def clone(self) -> Normals:
        """Return a copy that another thread can update at the same time."""
        other = copy(self)
        other._face_normals = np.zeros_like(self._face_normals)
        return other

    def update(self, points: Float32Array, out: Float32Array) -> None:
        """Write unit normals (n, 3) of the vertices `points` (n, 3)."""
        face_normals(points, self._faces, self._face_normals)
        vertex_normals(self._face_normals, self._starts, self._around, out)


def triangles_as_faces(triangles: IntArray) -> Int32Array:
    """Return triangles (m, 3) as faces (m, 4) that repeat their last corner."""
    return np.concatenate([triangles, triangles[:, 2:]], axis=1).astype(np.int32)
