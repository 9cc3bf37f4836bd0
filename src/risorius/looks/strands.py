"""Hairs: tapered curves rooted in the skin."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray, Int8Array, Int32Array


@dataclass(frozen=True, slots=True)
class Strands:
    """S hairs of P points each, rooted in skin triangles.

    roots       (S, 3) int32, vertices of the triangle
    weights     (S, 3) float32, barycentric place of the root in the triangle
    curves      (S, P, 3) float32, mm in the root's frame (see `root_frames`)
    widths      (S, P) float32, mm
    colours     (S, 3) float32, linear
    depths      (S,) float32, 0 (free) to 1 (buried: no light reaches the hair)
    bare        (S,) float32, 0 to 1: no hairs lie over the root, as at a parting
    gloss       strength of the highlights
    behind      a hair is drawn if the cosine between the normal at its root and the direction to the camera
                is greater than this
    """

    roots: Int32Array
    weights: Float32Array
    curves: Float32Array
    widths: Float32Array
    colours: Float32Array
    depths: Float32Array
    bare: Float32Array
    gloss: float
    behind: float = -0.45

    @property
    def vertices(self) -> int:
        """The number of vertices of the hairs' ribbons: two for each point."""
        return 2 * self.widths.size

    def triangles(self) -> Int32Array:
        """Return the triangles (2 S (P − 1), 3) of the ribbons, hair by hair; vertices count from 0."""
        strands, points = self.widths.shape
        pair = 2 * np.arange(strands * points).reshape(strands, points)[:, :-1, None, None]
        corners = (pair + np.array([[0, 1, 2], [1, 3, 2]])).reshape(-1, 3)
        return np.asarray(corners, np.int32)

    def segments(self) -> Int8Array:
        """Return the segment (2 S (P − 1),) of its hair, counted from the root, that each triangle is of."""
        strands, points = self.widths.shape
        return np.tile(np.repeat(np.arange(points - 1, dtype=np.int8), 2), strands)


def join(groups: list[Strands]) -> Strands:
    """Return groups of hairs with the same number of points as one group."""
    names = ("roots", "weights", "curves", "widths", "colours", "depths", "bare")
    arrays: dict[str, Any] = {name: np.concatenate([getattr(g, name) for g in groups]) for name in names}
    return replace(groups[0], **arrays)


def thinned(strands: Strands, number: int) -> Strands:
    """Return one in `number` hairs, `number` times as wide, which cover the same area."""
    names = ("roots", "weights", "curves", "colours", "depths", "bare")
    arrays: dict[str, Any] = {name: getattr(strands, name)[::number].copy() for name in names}
    return replace(strands, widths=strands.widths[::number] * np.float32(number), **arrays)


def root_frames(
    positions: FloatArray,
    normals: FloatArray,
    roots: Int32Array,
    weights: Float32Array,
) -> Array:
    """Return the frames (S, 3, 3) of roots.

    Their rows are the triangle's first edge, projected into the plane of the normal, the direction across it,
    and the normal.
    """
    normal = np.einsum("skc,sk->sc", np.asarray(normals, np.float64)[roots], weights)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    edge = np.asarray(positions[roots[:, 1]] - positions[roots[:, 0]], np.float64)
    edge -= np.einsum("sc,sc->s", edge, normal)[:, None] * normal
    edge /= np.linalg.norm(edge, axis=1, keepdims=True)
    return np.stack([edge, np.cross(normal, edge), normal], axis=1)


def flat_ribbons(strands: Strands, positions: FloatArray, normals: FloatArray) -> Array:
    """Return the vertices (2 S P, 3) of ribbons that lie flat on the skin with these points and normals.

    Those of a hair follow one another from root to tip, the left edge before the right.
    """
    frames = root_frames(positions, normals, strands.roots, strands.weights)
    origin = np.einsum("sk,skc->sc", strands.weights, positions[strands.roots])
    line = origin[:, None] + strands.curves @ frames
    ahead = np.empty_like(line)
    ahead[:, 1:-1] = line[:, 2:] - line[:, :-2]
    ahead[:, 0], ahead[:, -1] = line[:, 1] - line[:, 0], line[:, -1] - line[:, -2]
    across = np.cross(ahead, frames[:, None, 2])
    across /= np.maximum(np.linalg.norm(across, axis=2, keepdims=True), 1e-9)
    half = 0.5 * strands.widths[:, :, None] * across
    return np.stack([line - half, line + half], axis=2).reshape(-1, 3)
