"""Vectors of three float32 in registers, for use within kernels."""

from __future__ import annotations

import math

from ...core.arrays import Float32Array
from .jit import device, f4

Vec = tuple[float, float, float]
MatrixRows = tuple[Vec, Vec, Vec]


@device("fast")
def at(array: Float32Array, i: int) -> Vec:
    """Return row i, columns 0 to 2."""
    return array[i, 0], array[i, 1], array[i, 2]


@device("fast")
def add(a: Vec, b: Vec) -> Vec:
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@device("fast")
def sub(a: Vec, b: Vec) -> Vec:
    """Return a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@device("fast")
def scale(a: Vec, s: float) -> Vec:
    """Return a · s."""
    return a[0] * s, a[1] * s, a[2] * s


@device("fast")
def times(a: Vec, b: Vec) -> Vec:
    """Return the product by component."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


@device("fast")
def along(a: Vec, b: Vec, s: float) -> Vec:
    """Return a + b · s."""
    return a[0] + b[0] * s, a[1] + b[1] * s, a[2] + b[2] * s


@device("fast")
def mix(a: Vec, b: Vec, s: float) -> Vec:
    """Return a where s is 0, b where it is 1."""
    return a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s, a[2] + (b[2] - a[2]) * s


@device("fast")
def dot(a: Vec, b: Vec) -> float:
    """Return the inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@device("fast")
def cross(a: Vec, b: Vec) -> Vec:
    """Return the vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@device("fast")
def unit(a: Vec) -> Vec:
    """Return a at length 1 (a null vector stays null)."""
    s = f4(1) / math.sqrt(dot(a, a) + f4(1e-20))
    return a[0] * s, a[1] * s, a[2] * s


@device("fast")
def tilted(a: Vec, slope: Vec) -> Vec:
    """Return the unit vector a + slope, for a unit vector a and a small slope across it."""
    return scale(add(a, slope), f4(1) - f4(0.5) * dot(slope, slope))


@device("fast")
def rows_of(matrix: Float32Array) -> MatrixRows:
    """Return the rows of a matrix (3, 3)."""
    return at(matrix, 0), at(matrix, 1), at(matrix, 2)


@device("fast")
def turned(rows: MatrixRows, a: Vec) -> Vec:
    """Return a matrix of those rows · a."""
    return dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)


@device("fast")
def rotate(matrix: Float32Array, a: Vec) -> Vec:
    """Return matrix · a, for a matrix (3, 3)."""
    return turned(rows_of(matrix), a)


@device("fast")
def unrotate(matrix: Float32Array, a: Vec) -> Vec:
    """Return the transposed matrix (3, 3) · a: the inverse of `rotate` for a rotation."""
    return (
        matrix[0, 0] * a[0] + matrix[1, 0] * a[1] + matrix[2, 0] * a[2],
        matrix[0, 1] * a[0] + matrix[1, 1] * a[1] + matrix[2, 1] * a[2],
        matrix[0, 2] * a[0] + matrix[1, 2] * a[1] + matrix[2, 2] * a[2],
    )


@device("fast")
def weigh(array: Float32Array, corners: tuple[int, int, int], weights: Vec, first: int) -> Vec:
    """Return three columns from `first` on of a vertex array, at the barycentric weights in a triangle."""
    a, b, c = corners
    u, v, w = weights
    return (
        u * array[a, first] + v * array[b, first] + w * array[c, first],
        u * array[a, first + 1] + v * array[b, first + 1] + w * array[c, first + 1],
        u * array[a, first + 2] + v * array[b, first + 2] + w * array[c, first + 2],
    )


@device("fast")
def saturate(x: float) -> float:
    """Clip to 0..1."""
    return min(max(x, f4(0)), f4(1))


@device("fast")
def bounded(x: float, high: float) -> float:
    """Clip to 0..high, and take nan as 0: the result is safe to use as an index."""
    if x < high:
        return x if x > f4(0) else f4(0)
    return high if x >= high else f4(0)


@device("fast")
def smooth(low: float, high: float, x: float) -> float:
    """Return the smooth step: 0 up to `low`, 1 from `high` on."""
    t = saturate((x - low) / (high - low))
    return t * t * (f4(3) - f4(2) * t)
