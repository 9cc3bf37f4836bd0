"""The skin as a surface on which hairs grow: nearest places, normals, and hairs rooted in its triangles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..core.arrays import Array, Int32Array
from .strands import Strands, root_frames

_CANDIDATES = 10


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A skin at rest: vertices (n, 3) mm, unit normals (n, 3) and triangles (m, 3)."""

    points: Array
    normals: Array
    triangles: Int32Array

    def nearest(self, places: Array) -> tuple[Int32Array, Array]:
        """Return the triangles (S,) nearest to places (S, 3) mm, and barycentric weights (S, 3) in them."""
        corners = self.points[self.triangles]
        _, candidates = cKDTree(corners.mean(axis=1)).query(places, k=min(_CANDIDATES, len(corners)))
        weights = _project(places[:, None, :], corners[candidates])
        inside = np.clip(weights, 0.0, 1.0)
        inside /= inside.sum(axis=-1, keepdims=True)
        nearest = np.einsum("sck,sckd->scd", inside, corners[candidates])
        best = np.linalg.norm(nearest - places[:, None, :], axis=-1).argmin(axis=1)
        rows = np.arange(len(places))
        return candidates[rows, best].astype(np.int32), inside[rows, best]

    def at(self, triangles: Int32Array, weights: Array) -> tuple[Array, Array]:
        """Return positions (S, 3) mm and unit normals (S, 3) at weights (S, 3) in triangles (S,)."""
        corners = self.triangles[triangles]
        normal = np.einsum("sk,skd->sd", weights, self.normals[corners])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        return np.einsum("sk,skd->sd", weights, self.points[corners]), normal

    def root(
        self,
        triangles: Int32Array,
        weights: Array,
        curves: Array,
        widths: Array,
        colours: Array,
        depths: Array,
        gloss: float,
        bare: Array | None = None,
    ) -> Strands:
        """Return hairs that start at weights in triangles; `curves` (S, P, 3) mm stand in the head frame.

        The others are fields of `Strands`; `bare` is 0 where None.
        """
        roots = self.triangles[triangles]
        frames = root_frames(self.points, self.normals, roots, weights.astype(np.float32))
        origin = np.einsum("sk,skd->sd", weights, self.points[roots])
        local = np.einsum("spd,sfd->spf", curves - origin[:, None, :], frames)
        return Strands(
            roots.astype(np.int32),
            weights.astype(np.float32),
            local.astype(np.float32),
            widths.astype(np.float32),
            colours.astype(np.float32),
            depths.astype(np.float32),
            np.zeros(len(depths), np.float32) if bare is None else bare.astype(np.float32),
            gloss,
        )


def _project(places: Array, corners: Array) -> Array:
    """Return barycentric weights (S, C, 3) of places (S, 1, 3) projected into triangles (S, C, 3, 3)."""
    first, second = corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :]
    offset = places - corners[..., 0, :]
    aa, bb, ab = (first * first).sum(-1), (second * second).sum(-1), (first * second).sum(-1)
    oa, ob = (offset * first).sum(-1), (offset * second).sum(-1)
    scale = np.maximum(aa * bb - ab * ab, 1e-12)
    v, w = (bb * oa - ab * ob) / scale, (aa * ob - ab * oa) / scale
    return np.stack([1 - v - w, v, w], axis=-1)


def unit(vectors: Array) -> Array:
    """Return vectors (…, 3) scaled to length 1."""
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-12))


def flat(vectors: Array, normals: Array) -> Array:
    """Return vectors (…, 3) projected into the planes of unit normals (…, 3), at length 1."""
    return unit(vectors - (vectors * normals).sum(-1, keepdims=True) * normals)
