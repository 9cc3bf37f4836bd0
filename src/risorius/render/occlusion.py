"""The occlusion of each vertex of a head at rest, baked once for each head from depth maps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.arrays import Array, ByteArray, Float32Array, FloatArray, Int32Array
from ..machine.array_cache import cached_arrays
from ..machine.kernels.jit import f4, kernel
from .shadow import flatten, light_matrix, transform
from .visibility import Visibility

_SIZE = 512
_CONE = np.radians(20.0)  # half the angle under which a broad lamp is seen
_CONE_DIRECTIONS = 260  # over the whole sphere: eight within the cone


def sky_directions(count: int) -> Array:
    """Return `count` unit vectors (count, 3) spread evenly over the sphere (a golden spiral)."""
    k = np.arange(count) + 0.5
    height, angle = 1 - 2 * k / count, np.pi * (1 + 5**0.5) * k
    ring = np.sqrt(1 - height**2)
    return np.stack([ring * np.cos(angle), height, ring * np.sin(angle)], axis=1)


class Occluder(NamedTuple):
    """A mesh that shades itself: vertices and normals (n, 3), triangles (m, 3), two-sided or not (m,)."""

    points: Float32Array
    normals: Float32Array
    triangles: Int32Array
    two_sided: ByteArray


def bake(
    mesh: Occluder, centre: Array, radius: float, lamps: Float32Array
) -> tuple[Float32Array, Float32Array]:
    """Return the shares of its surroundings (n,) and of lamps (n, k − 1) that each vertex sees.

    The lamps are all of `lamps` (k, 7) but the first. Only what lies within `radius` mm of `centre` (3,)
    casts shade.
    """

    def find() -> tuple[Float32Array, Float32Array]:
        reach = [lamp_reach(mesh, centre, radius, lamp) for lamp in lamps[1:, :3]]
        free = ambient_occlusion(mesh, centre, radius)
        return free, np.stack(reach, axis=1) if reach else np.ones((len(free), 0), np.float32)

    free, reach = cached_arrays("occlusion", [*mesh, centre, radius, lamps], find)
    return free, reach


def ambient_occlusion(mesh: Occluder, centre: Array, radius: float, directions: int = 64) -> Float32Array:
    """Return the share (n,) float32 of the hemisphere over each vertex that is free, weighted by the cosine.

    `directions` is the number of directions that are tested.
    """
    return _seen(mesh, centre, radius, sky_directions(directions), cosine=True)


def lamp_reach(mesh: Occluder, centre: Array, radius: float, lamp: FloatArray) -> Float32Array:
    """Return the share (n,) float32 of a broad lamp in direction `lamp` (3,) that the scene lets through."""
    around = sky_directions(_CONE_DIRECTIONS)
    cone = around[around @ lamp > np.cos(_CONE)]
    return _seen(mesh, centre, radius, cone, cosine=False)


def _seen(mesh: Occluder, centre: Array, radius: float, directions: Array, *, cosine: bool) -> Float32Array:
    """Return the share (n,) of the directions (k, 3) that are free, weighted by the cosine or equally."""
    points, normals = mesh.points, mesh.normals
    buffer = Visibility(_SIZE, _SIZE, len(mesh.triangles), keep_ids=False)
    xy, key = np.zeros((len(points), 2), np.int32), np.zeros(len(points), np.float32)
    sums = np.zeros((len(points), 2), np.float32)
    bias = f4(3.0 * radius / _SIZE)
    for direction in directions:
        matrix = light_matrix(direction, centre, radius, _SIZE)
        flatten(points, matrix, xy, key)
        buffer.draw(xy, key, mesh.triangles, mesh.two_sided)
        _gather(points, normals, direction.astype(np.float32), matrix, buffer.depth, bias, cosine, sums)
    return np.asarray(sums[:, 0] / np.maximum(sums[:, 1], 1e-6), np.float32)


@kernel("f4[:, :], f4[:, :], f4[:], f4[:, :], f4[:, :], f4, b1, f4[:, :]")
def _gather(
    points: Float32Array,
    normals: Float32Array,
    direction: Float32Array,
    matrix: Float32Array,
    depth: Float32Array,
    bias: float,
    by_cosine: bool,
    sums: Float32Array,
) -> None:
    """Add one direction to each vertex's weight of free directions (column 0) and of all (column 1)."""
    for i in range(len(points)):
        x, y, z = normals[i, 0], normals[i, 1], normals[i, 2]
        weight = f4(1)
        if by_cosine:
            weight = x * direction[0] + y * direction[1] + z * direction[2]
            if weight <= f4(0):
                continue
        lifted = (points[i, 0] + x * bias, points[i, 1] + y * bias, points[i, 2] + z * bias)
        u, v, d = transform(matrix, lifted)
        sums[i, 1] += weight
        inside = f4(0) <= u < f4(depth.shape[1]) and f4(0) <= v < f4(depth.shape[0])
        if not inside or depth[int(v), int(u)] <= d + bias:
            sums[i, 0] += weight
