"""Filters of sampled sound: low-pass filters, resampling, and the smoothing of measured curves.

They are those of `scipy.signal` and `scipy.ndimage`, whose import takes longer than performing a line.
"""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array


def low_pass(window: Array, cutoff: float) -> Array:
    """Return the taps of a low-pass filter with linear phase and a gain of 1 at 0 Hz, of the window's length.

    `cutoff`: the frequency at which half passes, in units of half the sampling rate, 0 to 1.
    """
    place = np.arange(len(window)) - 0.5 * (len(window) - 1)
    taps = cutoff * np.sinc(cutoff * place) * window
    return np.asarray(taps / taps.sum())


def with_rate(samples: Array, up: int, down: int, taps: Array) -> Array:
    """Return samples (n,) at `up / down` times their rate, shape (ceil(n up / down),), zeros beyond the ends.

    `taps`: an odd number, of a low-pass filter at `up` times the samples' rate; its delay is taken out.
    """
    count = -(-len(samples) * up // down)
    half = len(taps) // 2
    phases = np.pad(up * taps, (0, -len(taps) % up)).reshape(-1, up).T
    width = phases.shape[1]
    last = (np.arange(up) * down + half) // up
    # Output k up + p is a sum over the inputs up to `last[p]` + k down: for each p one product of matrices.
    blocks = -(-count // up)
    needed = (blocks - 1) * down + int(last[-1]) + 1
    padded = np.pad(samples, (width - 1, max(needed - len(samples), 0)))
    windows = np.lib.stride_tricks.sliding_window_view(padded, width)
    output = np.empty((blocks, up))
    for p in range(up):
        rows = windows[last[p] :: down][:blocks]
        output[:, p] = rows @ phases[(p * down + half) % up, ::-1]
    return output.reshape(-1)[:count]


def median_of(values: Array, width: int) -> Array:
    """Return the median of the `width` values (odd) around each, shape (n,); the ends go on beyond."""
    return np.asarray(np.median(_around(values, width), axis=1))


def mean_of(values: Array, width: int) -> Array:
    """Return the mean of the `width` values (odd) around each, shape (n,); the ends go on beyond."""
    return np.asarray(_around(values, width).mean(axis=1))


def _around(values: Array, width: int) -> Array:
    return np.lib.stride_tricks.sliding_window_view(np.pad(values, width // 2, mode="edge"), width)
