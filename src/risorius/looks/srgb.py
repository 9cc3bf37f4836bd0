"""Conversion between sRGB colours and linear light."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array, FloatArray
from ..core.look import ByteColour


def srgb_encode(linear: FloatArray) -> Array:
    """Return sRGB values 0..1 of linear light 0..1 (IEC 61966-2-1)."""
    x = np.clip(np.asarray(linear, np.float64), 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def srgb_decode(encoded: FloatArray) -> Array:
    """Return linear light of sRGB values 0..1."""
    x = np.asarray(encoded, np.float64)
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)


def linear(colour: ByteColour) -> Array:
    """Return the linear albedo (3,) of an sRGB colour."""
    return srgb_decode(np.asarray(colour) / 255.0)
