"""Hairs: tapered curves rooted in the skin, drawn as ribbons that face the camera."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray, Int8Array, Int32Array


@dataclass(frozen=True, slots=True)
class Strands:
    """S hairs of P points each, rooted in skin triangles.

    `roots` (S, 3) int32 are the triangle's vertices and `weights` (S, 3) float32 the place in it; `curves`
    (S, P, 3) float32 mm stand in the root's frame (first edge made level, the third direction, normal);
    `widths` (S, P) mm are full widths; `colours` (S, 3) linear; `depths` (S,) 0..1 is how little light
    reaches the root (0 free, 1 buried); `gloss` is the strength of their highlights; a hair is drawn while
    the cosine between its root's normal and the way to the camera is more than `behind`.
    """

    roots: Int32Array
    weights: Float32Array
    curves: Float32Array
    widths: Float32Array
    colours: Float32Array
    depths: Float32Array
    gloss: float
    behind: float = -0.45

    @property
    def vertices(self) -> int:
        """How many vertices the ribbons have: two for each point."""
        return 2 * self.widths.size

    def triangles(self) -> Int32Array:
        """Return the ribbons' triangles (2 S (P − 1), 3), counting vertices from 0, hair by hair."""
        strands, points = self.widths.shape
        pair = 2 * np.arange(strands * points).reshape(strands, points)[:, :-1, None, None]
        corners = (pair + np.array([[0, 1, 2], [1, 3, 2]])).reshape(-1, 3)
        return np.asarray(corners, np.int32)

    def segments(self) -> Int8Array:
        """Return which part of its hair, counted from the root, each of `triangles` is."""
        strands, points = self.widths.shape
        return np.tile(np.repeat(np.arange(points - 1, dtype=np.int8), 2), strands)


def join(groups: list[Strands]) -> Strands:
    """Return several groups of hairs, of equally many points, as one."""
    names = ("roots", "weights", "curves", "widths", "colours", "depths")
    arrays: dict[str, Any] = {name: np.concatenate([getattr(g, name) for g in groups]) for name in names}
    return replace(groups[0], **arrays)


def root_frames(
    positions: FloatArray,
    normals: FloatArray,
    roots: Int32Array,
    weights: Float32Array,
) -> Array:
    """Return the frames (S, 3, 3) of roots, as rows: along the first edge, across it, normal."""
    normal = np.einsum("skc,sk->sc", np.asarray(normals, np.float64)[roots], weights)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    edge = np.asarray(positions[roots[:, 1]] - positions[roots[:, 0]], np.float64)
    edge -= np.einsum("sc,sc->s", edge, normal)[:, None] * normal
    edge /= np.linalg.norm(edge, axis=1, keepdims=True)
    return np.stack([edge, np.cross(normal, edge), normal], axis=1)
