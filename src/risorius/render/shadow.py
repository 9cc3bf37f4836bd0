"""The shadow of the key light: a depth map seen from the lamp, compared over a soft neighbourhood."""

from __future__ import annotations

import numpy as np

from ..core.arrays import ByteArray, Float32Array, FloatArray, Int32Array
from ..machine.kernels.jit import device, f4, index, kernel
from ..machine.kernels.vec import Vec, at
from .camera import snap
from .visibility import Visibility

SIZE, DRAFT_SIZE = 384, 192
REACH = 2  # taps on each side
_TAPS = 2 * REACH + 2  # `find_bounds` and `_tent` are written for six
RAMP = f4(0.5)
"""1/mm: depths are compared over 2 mm, which hides the steps of the map."""


class ShadowMap:
    """A map of `size`² texels over a sphere that holds the scene.

    `low` and `high` (size, size) float32 are the least and the greatest depth among the taps that start at a
    texel. Most places are fully lit or fully in the shade, and these two decide them. `vertices` and
    `triangles` are how many points and triangles cast the shadow.
    """

    def __init__(
        self,
        direction: FloatArray,
        centre: FloatArray,
        radius: float,
        vertices: int,
        triangles: int,
        size: int = SIZE,
    ) -> None:
        self.matrix = light_matrix(direction, centre, radius, size)
        self.bias = bias_of(radius, size)
        self.vertices = vertices
        self._xy: Int32Array = np.zeros((vertices, 2), np.int32)
        self._key: Float32Array = np.zeros(vertices, np.float32)
        self.low, self.high, self._rows = (np.zeros((size, size), np.float32) for _ in range(3))
        self._buffer = Visibility(size, size, triangles, keep_ids=False)

    @property
    def depth(self) -> Float32Array:
        """The map (size, size) float32: mm towards the lamp from the sphere's far side, 0 where empty."""
        return self._buffer.depth

    def update(self, points: Float32Array, triangles: Int32Array, two_sided: ByteArray) -> None:
        """Draw the map for new positions."""
        flatten(points, self.matrix, self._xy, self._key)
        self._buffer.draw(self._xy, self._key, triangles, two_sided)
        find_bounds(self.depth, self._rows, self.low, self.high)


def bias_of(radius: float, size: int) -> float:
    """Return the depth in mm that a texel spans on a slanted surface."""
    return 3.2 * radius / size


def light_matrix(direction: FloatArray, centre: FloatArray, radius: float, size: int) -> Float32Array:
    """Return the matrix (3, 4) float32 whose rows give x and y in texels and mm towards the lamp.

    The map covers the sphere of this radius about `centre`, whose far side has depth 1 mm.
    """
    ahead = np.asarray(direction, np.float64) / np.linalg.norm(direction)
    side = np.cross((0.0, 1.0, 0.0) if abs(ahead[1]) < 0.99 else (1.0, 0.0, 0.0), ahead)
    side /= np.linalg.norm(side)
    scale = size / (2 * radius)
    rows = np.stack([side * scale, -np.cross(ahead, side) * scale, ahead])
    offset = np.array([size / 2, size / 2, radius + 1.0]) - rows @ np.asarray(centre, np.float64)
    return np.concatenate([rows, offset[:, None]], axis=1).astype(np.float32)


@device("fast")
def transform(matrix: Float32Array, p: Vec) -> Vec:
    """Return matrix (3, 4) · (p, 1)."""
    return (
        matrix[0, 0] * p[0] + matrix[0, 1] * p[1] + matrix[0, 2] * p[2] + matrix[0, 3],
        matrix[1, 0] * p[0] + matrix[1, 1] * p[1] + matrix[1, 2] * p[2] + matrix[1, 3],
        matrix[2, 0] * p[0] + matrix[2, 1] * p[1] + matrix[2, 2] * p[2] + matrix[2, 3],
    )


@kernel("f4[:, :], f4[:, :], i4[:, :], f4[:]")
def flatten(points: Float32Array, matrix: Float32Array, xy: Int32Array, key: Float32Array) -> None:
    """Write positions in 1/256 texel and depths of points (n, 3) for `light_matrix`."""
    for i in range(len(points)):
        u, v, d = transform(matrix, at(points, i))
        xy[i, 0] = snap(u)
        xy[i, 1] = snap(v)
        key[i] = max(d, f4(0.001))


@kernel("f4[:, :], f4[:, :], f4[:, :], f4[:, :]")
def find_bounds(depth: Float32Array, rows: Float32Array, low: Float32Array, high: Float32Array) -> None:
    """Write the least and the greatest depth among the _TAPS × _TAPS texels that start at each texel.

    The loops are written out for six taps: so they become vector code, which is twelve times as fast.
    """
    size = depth.shape[0]
    last = size - _TAPS + 1
    for j in range(size):
        for i in range(last):
            rows[j, i] = max(
                max(depth[j, i], depth[j, i + 1], depth[j, i + 2]),
                max(depth[j, i + 3], depth[j, i + 4], depth[j, i + 5]),
            )
    for j in range(last):
        for i in range(last):
            high[j, i] = max(
                max(rows[j, i], rows[j + 1, i], rows[j + 2, i]),
                max(rows[j + 3, i], rows[j + 4, i], rows[j + 5, i]),
            )
    for j in range(size):
        for i in range(last):
            rows[j, i] = min(
                min(depth[j, i], depth[j, i + 1], depth[j, i + 2]),
                min(depth[j, i + 3], depth[j, i + 4], depth[j, i + 5]),
            )
    for j in range(last):
        for i in range(last):
            low[j, i] = min(
                min(rows[j, i], rows[j + 1, i], rows[j + 2, i]),
                min(rows[j + 3, i], rows[j + 4, i], rows[j + 5, i]),
            )


@device("fast")
def lit(
    depth: Float32Array, low: Float32Array, high: Float32Array, matrix: Float32Array, p: Vec, bias: float
) -> float:
    """Return the share of the lamp seen from p, 0..1: a tent over _TAPS texels each way."""
    u, v, d = transform(matrix, p)
    x, y = u - f4(0.5), v - f4(0.5)
    i, j = int(x), int(y)
    size = depth.shape[0]
    if i < REACH or j < REACH or i >= size - 8 + REACH or j >= size - REACH - 1:
        return f4(1)
    near = d + bias
    if high[index(j - REACH), index(i - REACH)] <= near:
        return f4(1)
    if (low[index(j - REACH), index(i - REACH)] - near) * RAMP >= f4(1):
        return f4(0)
    return _tent(depth, i, j, x - f4(i), y - f4(j), near)


@device("fast sums")
def _tent(depth: Float32Array, i: int, j: int, s: float, t: float, near: float) -> float:
    """Return the share of texels about (i + s, j + t) that lie no nearer to the lamp than `near`.

    All taps are in one loop of rows of eight, the last two without weight, so that it becomes vector code.
    """
    total, reach = f4(0), f4(REACH + 1)
    for tap in range(8 * _TAPS):
        row, column = (tap >> 3) - REACH, (tap & 7) - REACH
        blocked = min(max((depth[index(j + row), index(i + column)] - near) * RAMP, f4(0)), f4(1))
        weight = max(reach - abs(f4(column) - s), f4(0)) * (reach - abs(f4(row) - t))
        total += (f4(1) - blocked) * weight
    whole = reach * reach
    return total / (whole * whole)
