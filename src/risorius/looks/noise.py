"""Solid noise: a periodic tile of smooth random heights, looked up at positions of the head at rest.

A solid has no seams, and a pattern looked up at rest moves with the skin.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray
from ..machine.kernels.jit import f8, i8, index, kernel

SIZE = 64
MASK = index(SIZE - 1)
_SEED = 20040611


@lru_cache(maxsize=1)
def noise_tile() -> Float32Array:
    """Return the tile (SIZE, SIZE, SIZE) float32, indexed z, y, x: heights of variance 1.

    Its waves are 4 to 10 cells long: fine grain of no direction, which does not visibly repeat.
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
    """Return heights (n,) of variance 1 at points (n, 3) mm, with waves of about `wavelength` mm."""
    heights = np.empty(len(points))
    _interpolate(noise_tile(), points * (6.5 / wavelength) + 0.37 * SIZE, heights)
    return heights


@kernel("f4[:, :, :], f8[:, :], f8[:]")
def _interpolate(tile: Float32Array, cells: FloatArray, out: Array) -> None:
    """Write heights (n,) at places (n, 3) in cells, interpolated between the corners of each cell."""
    for k in range(len(cells)):
        i, j, m = i8(math.floor(cells[k, 0])), i8(math.floor(cells[k, 1])), i8(math.floor(cells[k, 2]))
        u, v, w = f8(cells[k, 0]) - i, f8(cells[k, 1]) - j, f8(cells[k, 2]) - m
        total = f8(0)
        for corner in range(8):
            right, down, deep = corner >> 2, (corner >> 1) & 1, corner & 1
            weight = (u if right else f8(1) - u) * (v if down else f8(1) - v) * (w if deep else f8(1) - w)
            total += tile[(m + deep) & MASK, (j + down) & MASK, (i + right) & MASK] * weight
        out[k] = total
