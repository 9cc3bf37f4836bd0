"""Solid noise: a tile of smooth random heights with their slopes, looked up at rest positions.

Being solid it has no seams and rides on the skin.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray
from .jit import device, exact_kernel, f4, f8, i8, index
from .vec import Vec

SIZE = 64
_MASK = index(SIZE - 1)
_ONE = index(1)
_SHIFT = f4(SIZE << 7)  # whole tiles: cells are counted without sign
_SEED = 20040611

Cell = tuple[int, int, int]
Heights = tuple[float, float, float, float, float, float, float, float]


@lru_cache(maxsize=1)
def noise_tile() -> Float32Array:
    """Return the tile (SIZE, SIZE, SIZE) float32, indexed z, y, x: heights of variance 1.

    Waves of 4 to 10 cells: fine grain without a direction and without visible repetition at that scale.
    """
    spectrum = np.fft.fftn(np.random.default_rng(_SEED).standard_normal((SIZE,) * 3))
    axis = np.fft.fftfreq(SIZE)
    fz, fy, fx = np.meshgrid(axis, axis, axis, indexing="ij")
    spectrum *= np.exp(-(((np.sqrt(fx**2 + fy**2 + fz**2) - 0.15) / 0.06) ** 2))
    height = np.fft.ifftn(spectrum).real
    tile: Float32Array = (height / height.std()).astype(np.float32)
    tile.setflags(write=False)
    return tile


def noise_at(points: FloatArray, wavelength: float) -> Array:
    """Return heights (n,) of variance 1 at points (n, 3) mm whose waves are about `wavelength` mm long."""
    heights = np.empty(len(points))
    _interpolate(noise_tile(), points * (6.5 / wavelength) + 0.37 * SIZE, heights)
    return heights


@exact_kernel
def _interpolate(tile: Float32Array, cells: FloatArray, out: Array) -> None:
    """Write heights (n,) at places (n, 3) in cells, linearly between the corners of each cell."""
    for k in range(len(cells)):
        i, j, m = i8(math.floor(cells[k, 0])), i8(math.floor(cells[k, 1])), i8(math.floor(cells[k, 2]))
        u, v, w = f8(cells[k, 0]) - i, f8(cells[k, 1]) - j, f8(cells[k, 2]) - m
        total = f8(0)
        for corner in range(8):
            right, down, deep = corner >> 2, (corner >> 1) & 1, corner & 1
            weight = (u if right else f8(1) - u) * (v if down else f8(1) - v) * (w if deep else f8(1) - w)
            total += tile[(m + deep) & _MASK, (j + down) & _MASK, (i + right) & _MASK] * weight
        out[k] = total


@device
def cell_of(point: Vec, cells: float) -> tuple[Cell, Vec]:
    """Return the cell in which a point in mm lies, with `cells` cells to the millimetre, and where in it."""
    x, y, z = point[0] * cells + _SHIFT, point[1] * cells + _SHIFT, point[2] * cells + _SHIFT
    i, j, k = index(x), index(y), index(z)
    return (i & _MASK, j & _MASK, k & _MASK), (x - f4(i), y - f4(j), z - f4(k))


@device
def heights_about(tile: Float32Array, cell: Cell) -> Heights:
    """Return the heights at the eight corners of a cell: x runs first, z last."""
    i, j, k = cell
    right, down, deep = (i + _ONE) & _MASK, (j + _ONE) & _MASK, (k + _ONE) & _MASK
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


@device
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


@device
def grain(tile: Float32Array, point: Vec, cells: float) -> tuple[float, float, float, float]:
    """Return height and slope (per mm) of the tile at a point in mm, with `cells` cells to the millimetre."""
    cell, way = cell_of(point, cells)
    return between(heights_about(tile, cell), way, cells)


@device
def _layer(a: float, b: float, c: float, d: float, u: float, v: float) -> tuple[float, float, float]:
    """Return height and slopes per cell in x and y within a layer of four corners."""
    near, far = a + (b - a) * u, c + (d - c) * u
    return near + (far - near) * v, (b - a) + (d - c - b + a) * v, far - near
