"""Heights and slopes of the solid noise at single points, for shading."""

from __future__ import annotations

from ..core.arrays import Float32Array
from ..looks.noise import MASK, SIZE
from ..machine.kernels.jit import device, f4, index
from ..machine.kernels.vec import Vec

_ONE = index(1)
_SHIFT = f4(SIZE << 7)  # a whole number of tiles, so that cells are counted without sign
Cell = tuple[int, int, int]
Heights = tuple[float, float, float, float, float, float, float, float]


@device("fast")
def cell_of(point: Vec, cells: float) -> tuple[Cell, Vec]:
    """Return the cell of a point in mm, and its place in the cell; `cells` is the number of cells per mm."""
    x, y, z = point[0] * cells + _SHIFT, point[1] * cells + _SHIFT, point[2] * cells + _SHIFT
    i, j, k = index(x), index(y), index(z)
    return (i & MASK, j & MASK, k & MASK), (x - f4(i), y - f4(j), z - f4(k))


@device("fast")
def heights_about(tile: Float32Array, cell: Cell) -> Heights:
    """Return the heights at the eight corners of a cell: x varies fastest, z slowest."""
    i, j, k = cell
    right, down, deep = (i + _ONE) & MASK, (j + _ONE) & MASK, (k + _ONE) & MASK
    return (
        tile[k, j, i],
        tile[k, j, right],
        tile[k, down, i],
        tile[k, down, right],
        tile[deep, j, i],
        tile[deep, j, right],
        tile[deep, down, i],
        tile[deep, down, right],
    )


@device("fast")
def between(h: Heights, way: Vec, cells: float) -> tuple[float, float, float, float]:
    """Return height and slope (per mm) at a place within a cell of those heights."""
    low, low_x, low_y = _layer(h[0], h[1], h[2], h[3], way[0], way[1])
    high, high_x, high_y = _layer(h[4], h[5], h[6], h[7], way[0], way[1])
    rise, w = high - low, way[2]
    return (
        low + rise * w,
        (low_x + (high_x - low_x) * w) * cells,
        (low_y + (high_y - low_y) * w) * cells,
        rise * cells,
    )


@device("fast")
def grain(tile: Float32Array, point: Vec, cells: float) -> tuple[float, float, float, float]:
    """Return height and slope (per mm) of the tile at a point in mm, with `cells` cells per mm."""
    cell, way = cell_of(point, cells)
    return between(heights_about(tile, cell), way, cells)


@device("fast")
def _layer(a: float, b: float, c: float, d: float, u: float, v: float) -> tuple[float, float, float]:
    """Return height and slopes per cell in x and y within a layer of four corners."""
    near, far = a + (b - a) * u, c + (d - c) * u
    return near + (far - near) * v, (b - a) + (d - c - b + a) * v, far - near
