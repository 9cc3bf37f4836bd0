"""How alike two pictures are."""

from __future__ import annotations

import numpy as np

from risorius.core.arrays import Array, ByteArray

_SIDE = 8
_STABLE_MEAN, _STABLE_VARIANCE = (0.01 * 255) ** 2, (0.03 * 255) ** 2


def structural_similarity(one: ByteArray, other: ByteArray) -> float:
    """Return the SSIM of two pictures (height, width, channels), 1 if equal, over windows of 8 × 8 pixels.

    It is the least of all channels. Source: Wang, Bovik, Sheikh and Simoncelli 2004, with flat windows.
    Raises ValueError if the pictures differ in shape.
    """
    if one.shape != other.shape:
        raise ValueError(f"pictures of {one.shape} and {other.shape}; expected the same shape")
    return min(
        _channel_similarity(one[..., c].astype(float), other[..., c].astype(float))
        for c in range(one.shape[2])
    )


def _channel_similarity(x: Array, y: Array) -> float:
    mean_x, mean_y = _means(x), _means(y)
    variances = _means(x * x) - mean_x**2 + _means(y * y) - mean_y**2
    covariance = _means(x * y) - mean_x * mean_y
    means = (2 * mean_x * mean_y + _STABLE_MEAN) / (mean_x**2 + mean_y**2 + _STABLE_MEAN)
    return float((means * (2 * covariance + _STABLE_VARIANCE) / (variances + _STABLE_VARIANCE)).mean())


def _means(x: Array) -> Array:
    return np.lib.stride_tricks.sliding_window_view(x, (_SIDE, _SIDE)).mean(axis=(2, 3))
