"""Short-time levels in bands, fine enough in time to place the edges of phones."""

from __future__ import annotations

import functools

import numpy as np

from ...core.arrays import Array, Int64Array
from ..resampled import RATE

# Samples at 16 kHz: 2.5 ms steps, 8 ms windows.
STEP, WINDOW = 40, 128
STEP_SECONDS = STEP / RATE
BANDS = 12
_LOWEST, _HIGHEST = 80.0, 8_000.0
# Power of the softest sound that is told from silence, so that the level of digital silence is finite.
_FLOOR = 10.0 * WINDOW
_LOUD_PERCENTILE = 95.0


def band_levels(sound: Array) -> Array:
    """Return natural-log power in 12 bands, even on the mel scale, every 2.5 ms: shape (steps, 12).

    Row k is of the window around sample 40 k. Levels are relative to the mean of the loudest steps.
    """
    steps = len(sound) // STEP + 1
    padded = np.pad(sound, (WINDOW // 2, WINDOW))
    frames = np.lib.stride_tricks.sliding_window_view(padded, WINDOW)[::STEP][:steps]
    spectrum = np.fft.rfft(frames * np.hanning(WINDOW))
    levels = np.log((spectrum.real**2 + spectrum.imag**2) @ _bank() + _FLOOR)
    return np.asarray(levels - np.percentile(levels.mean(axis=1), _LOUD_PERCENTILE))


def edge_steps(levels: Array, edges: Array) -> Int64Array:
    """Return the steps (n + 1,) at which n phones start and end, for the `edges` (n - 1,) s between them.

    The first phone starts with the sound whose `levels` (steps, 12) are given, the last ends with it.
    """
    bounds = np.array([0.0, *edges, len(levels) * STEP_SECONDS])
    return np.round(bounds / STEP_SECONDS).astype(np.int64)


@functools.cache
def _bank() -> Array:
    """Return triangular filters, shape (WINDOW / 2 + 1, BANDS), each of weight 1."""
    frequencies = np.fft.rfftfreq(WINDOW, 1.0 / RATE)
    edges = _hertz(np.linspace(_mel(_LOWEST), _mel(_HIGHEST), BANDS + 2))
    filters = np.zeros((len(frequencies), BANDS))
    for band, (low, middle, high) in enumerate(zip(edges, edges[1:], edges[2:], strict=False)):
        rising, falling = (frequencies - low) / (middle - low), (high - frequencies) / (high - middle)
        filters[:, band] = np.clip(np.minimum(rising, falling), 0.0, None)
        if not filters[:, band].any():
            # Narrower than the window resolves: its nearest frequency alone.
            filters[np.argmin(np.abs(frequencies - middle)), band] = 1.0
    return np.asarray(filters / filters.sum(axis=0))


def _mel(hertz: float) -> float:
    return 2595.0 * float(np.log10(1.0 + hertz / 700.0))


def _hertz(mel: Array) -> Array:
    return np.asarray(700.0 * (10.0 ** (mel / 2595.0) - 1.0))
