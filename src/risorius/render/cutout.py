"""Pictures with an alpha channel, for a head that is drawn over something else."""

from __future__ import annotations

import numpy as np

from ..core.arrays import ByteArray, Float32Array, Int32Array
from ..looks.srgb import srgb_decode, srgb_encode

_LEAST = 1 / 512


def covered(ids: Int32Array, samples: int) -> Float32Array:
    """Return the share (height, width) float32 of each pixel's samples that show something."""
    shown = ids >= 0
    total = np.zeros((shown.shape[0] // samples, shown.shape[1] // samples), np.float32)
    for row in range(samples):
        for column in range(samples):
            total += shown[row::samples, column::samples]
    total *= 1.0 / (samples * samples)
    return total


def cut_out(picture: ByteArray, share: Float32Array, out: ByteArray) -> None:
    """Write a picture (height, width, 3) drawn on black as RGBA into `out`, with straight alpha."""
    out[..., :3] = picture
    out[..., 3] = share * 255.0 + 0.5
    edge = (share > _LEAST) & (share < 1.0)
    light = srgb_decode(picture[edge] / 255.0) / share[edge][:, None]
    out[edge, :3] = srgb_encode(light) * 255.0 + 0.5
