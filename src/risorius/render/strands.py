"""Hairs: tapered curves rooted in the skin, drawn as ribbons that face the camera."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray, Int8Array, Int32Array
from .jit import exact, exact_kernel, f4, i8
from .vec import Vec, along, at, cross, dot, scale, sub, unit, weigh

WHOLE, NOTHING = (0, 127), (127, -1)
"""First and last point to be drawn of a hair of any number of points, and of one that is not drawn."""
_GOLDEN = f4(0.61803)  # steps of this part of a turn are spread evenly, however many there are


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

    def parts(self) -> Int8Array:
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


@exact
def _frame(
    positions: Float32Array, normals: Float32Array, corners: tuple[int, int, int], place: Vec
) -> tuple[Vec, Vec, Vec]:
    normal = unit(weigh(normals, corners, place, 0))
    edge = sub(at(positions, corners[1]), at(positions, corners[0]))
    edge = unit(along(edge, normal, -dot(edge, normal)))
    return edge, cross(normal, edge), normal


@exact
def _point(curves: Float32Array, s: int, k: int, origin: Vec, frame: tuple[Vec, Vec, Vec]) -> Vec:
    p = along(origin, frame[0], curves[s, k, 0])
    p = along(p, frame[1], curves[s, k, 1])
    return along(p, frame[2], curves[s, k, 2])


@exact
def _collapse(positions: Float32Array, normals: Float32Array, start: int, end: int, place: Vec) -> None:
    """Bring vertices of a ribbon to one place, so that nothing of it is drawn, nor lit."""
    for row in range(start, end):
        positions[row, 0], positions[row, 1], positions[row, 2] = place
        normals[row, 0], normals[row, 1], normals[row, 2] = f4(0), f4(0), f4(0)


@exact
def _double(positions: Float32Array, normals: Float32Array, start: int, end: int, like: int) -> None:
    """Bring pairs of vertices of a ribbon to where the pair `like` is, so that it ends there."""
    for row in range(start, end, 2):
        for side in range(2):
            for column in range(3):
                positions[row + side, column] = positions[like + side, column]
                normals[row + side, column] = f4(0)


@exact_kernel
def ribbons(
    positions: Float32Array,
    normals: Float32Array,
    roots: Int32Array,
    weights: Float32Array,
    curves: Float32Array,
    widths: Float32Array,
    shown: Int8Array,
    eye: Float32Array,
    first: int,
    behind: float,
    least: float,
) -> None:
    """Write the ribbons' vertices into `positions` and their directions into `normals`, from row `first` on.

    Roots are looked up in the same arrays; `eye` (3,) is where the camera stands. Hairs whose roots face away
    from it, with a cosine below `behind`, are left out, and of the others what lies outside the first and
    the last point `shown` (S, 2). None is drawn narrower than `least` mm, or it would break up between the
    samples; of hairs that are, as many are left out as make up for it.
    """
    strands, points = widths.shape
    camera = (eye[0], eye[1], eye[2])
    for s in range(strands):
        corners = (roots[s, 0], roots[s, 1], roots[s, 2])
        place = (weights[s, 0], weights[s, 1], weights[s, 2])
        origin = weigh(positions, corners, place, 0)
        frame = _frame(positions, normals, corners, place)
        spread = f4(s) * _GOLDEN
        crowded = (spread - math.floor(spread)) * least > widths[s, 0]
        start, end = i8(shown[s, 0]), min(i8(shown[s, 1]), points - 1)
        row = first + 2 * s * points
        if crowded or start >= end or dot(frame[2], unit(sub(camera, origin))) < behind:
            _collapse(positions, normals, row, row + 2 * points, origin)
            continue
        here = _point(curves, s, start, origin, frame)
        ahead = (f4(0), f4(0), f4(0))
        for k in range(start, end + 1):
            point = here
            if k + 1 < points:
                here = _point(curves, s, k + 1, origin, frame)
                ahead = unit(sub(here, point))
            wide = max(widths[s, k], least) * f4(0.5)
            side = scale(unit(cross(sub(camera, point), ahead)), wide)
            for column in range(3):
                positions[row + 2 * k, column] = point[column] - side[column]
                positions[row + 2 * k + 1, column] = point[column] + side[column]
                normals[row + 2 * k, column] = ahead[column]
                normals[row + 2 * k + 1, column] = ahead[column]
        _double(positions, normals, row, row + 2 * start, row + 2 * start)
        _double(positions, normals, row + 2 * (end + 1), row + 2 * points, row + 2 * end)
