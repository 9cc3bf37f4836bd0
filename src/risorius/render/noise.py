"""Solid noise: a tile of smooth random heights with their slopes, looked up at rest positions.

Being solid it has no seams and rides on the skin.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from .jit import device, f4
from .raster import FloatArray
from .vec import Vec

SIZE = 64
_MASK = SIZE - 1
_SEED = 20040611


@lru_cache(maxsize=1)
def noise_tile() -> FloatArray:
    """Return the tile (SIZE, SIZE, SIZE, 4) float32: height of variance 1, and its slope per cell in x, y, z.

    Waves of 4 to 10 cells: fine grain without a direction and without visible repetition at that scale.
    """
    spectrum = np.fft.fftn(np.random.default_rng(_SEED).standard_normal((SIZE,) * 3))
    axis = np.fft.fftfreq(SIZE)
    fz, fy, fx = np.meshgrid(axis, axis, axis, indexing="ij")
    spectrum *= np.exp(-(((np.sqrt(fx**2 + fy**2 + fz**2) - 0.15) / 0.06) ** 2))
    height = np.fft.ifftn(spectrum).real
    spectrum /= height.std()
    waves = [spectrum, *(spectrum * (2j * math.pi * f) for f in (fx, fy, fz))]
    tile: FloatArray = np.stack([np.fft.ifftn(w).real for w in waves], axis=-1).astype(np.float32)
    tile.setflags(write=False)
    return tile


def noise_at(points: npt.NDArray[np.floating], wavelength: float) -> npt.NDArray[np.float64]:
    """Return heights (n,) of variance 1 at points (n, 3) mm whose waves are about `wavelength` mm long."""
    cell = points * (6.5 / wavelength) + 0.37 * SIZE
    low = np.floor(cell).astype(np.int64)
    fraction = cell - low
    tile, total = noise_tile()[..., 0], np.zeros(len(points))
    for corner in np.ndindex(2, 2, 2):
        x, y, z = ((low + corner) & _MASK).T
        total += tile[z, y, x] * np.prod(np.where(corner, fraction, 1 - fraction), axis=1)
    return total


@device
def grain(tile: FloatArray, point: Vec, cells: float) -> tuple[float, float, float, float]:
    """Return height and slope (per mm) of the tile at a point in mm, with `cells` cells to the millimetre."""
    x, y, z = point[0] * cells + f4(1024), point[1] * cells + f4(1024), point[2] * cells + f4(1024)
    i, j, k = int(x), int(y), int(z)
    u, v, w = x - f4(i), y - f4(j), z - f4(k)
    h, gx, gy, gz = f4(0), f4(0), f4(0), f4(0)
    for corner in range(8):
        a, b, c = corner & 1, (corner >> 1) & 1, corner >> 2
        weight = (u if a else f4(1) - u) * (v if b else f4(1) - v) * (w if c else f4(1) - w)
        c, b, a = (k + c) & _MASK, (j + b) & _MASK, (i + a) & _MASK
        h += weight * tile[c, b, a, 0]
        gx += weight * tile[c, b, a, 1]
        gy += weight * tile[c, b, a, 2]
        gz += weight * tile[c, b, a, 3]
    return h, gx * cells, gy * cells, gz * cells
