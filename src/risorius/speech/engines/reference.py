"""Phone times of a voice that gives none: those of espeak-ng's voice, warped onto its sound.

Both say the same words, so that their spectra match in order: dynamic time warping of log mel spectra,
normalised over the stretch (Sakoe and Chiba 1978).
"""

from __future__ import annotations

from functools import cache

import numpy as np

from ...core.arrays import Array, Int8Array, Int64Array
from ...core.speech.audio import Samples
from .protocol import Rendition, SpokenPhone

HOP, WINDOW = 0.010, 0.025
_BANDS, _LOWEST, _HIGHEST = 20, 100.0, 5000.0
# A frame this far below the loudest one counts as silence (natural logarithm of power).
_FLOOR = 12.0
# A path may stay this many times cheaper on the diagonal than beside it.
_BESIDE = 1.3
# The origin of a step of the path: both, only a frame of the first, only one of the second.
_FROM_A, _FROM_B = 1, 2


def warped(reference: Rendition, samples: Samples, sample_rate: int) -> tuple[SpokenPhone, ...]:
    """Return the phones of `reference` at the times at which `samples`, the same words, have them."""
    if not reference.phones or not len(samples):
        return ()
    source = np.array([phone.start for phone in reference.phones]) / reference.sample_rate
    times = _map(source, _features(reference.samples, reference.sample_rate), _features(samples, sample_rate))
    limit = len(samples) - 1
    starts = np.maximum.accumulate(np.minimum(np.round(times * sample_rate).astype(int), limit))
    scale = sample_rate / reference.sample_rate
    return tuple(
        phone._replace(start=int(start), closure=round(phone.closure * scale))
        for phone, start in zip(reference.phones, starts, strict=True)
    )


def _map(times: Array, a: Array, b: Array) -> Array:
    path = _path(a, b)
    first, rows = np.unique(path[:, 0], return_index=True)
    last = np.append(rows[1:], len(path)) - 1
    middle = 0.5 * (path[rows, 1] + path[last, 1])
    return np.asarray(np.interp(times, first * HOP, middle * HOP))


def _path(a: Array, b: Array) -> Int64Array:
    """Return the cheapest path (steps, 2) of frames from the first to the last of both."""
    step = _steps(_distances(a, b))
    i, j = len(a) - 1, len(b) - 1
    path = []
    while i >= 0 and j >= 0:
        path.append((i, j))
        move = step[i, j]
        i, j = i - (move != _FROM_B), j - (move != _FROM_A)
    return np.array(path[::-1])


def _distances(a: Array, b: Array) -> Array:
    """Return the distances (frames of a, frames of b) of spectra."""
    squared = (a**2).sum(axis=1)[:, None] + (b**2).sum(axis=1)[None, :] - 2.0 * a @ b.T
    return np.asarray(np.sqrt(np.maximum(squared, 0.0)))


def _steps(distance: Array) -> Int8Array:
    """Return from where the cheapest path comes to each pair of frames, diagonal by diagonal."""
    n, m = distance.shape
    total = np.full((n + 1, m + 1), np.inf)
    total[0, 0] = 0.0
    step = np.zeros((n, m), np.int8)
    for diagonal in range(n + m - 1):
        i = np.arange(max(0, diagonal - m + 1), min(diagonal, n - 1) + 1)
        j = diagonal - i
        d = distance[i, j]
        ways = np.stack((total[i, j] + d, total[i, j + 1] + _BESIDE * d, total[i + 1, j] + _BESIDE * d))
        best = np.argmin(ways, axis=0)
        total[i + 1, j + 1] = ways[best, np.arange(len(i))]
        step[i, j] = best
    return step


def _features(samples: Samples, sample_rate: int) -> Array:
    """Return log mel spectra (frames, bands), each band with mean 0 and deviation 1 over the stretch."""
    hop, window = round(HOP * sample_rate), round(WINDOW * sample_rate)
    padded = np.pad(samples.astype(np.float64), (window // 2, window))
    count = max(len(samples) // hop, 1)
    frames = np.stack([padded[k * hop : k * hop + window] for k in range(count)]) * np.hanning(window)
    power = np.abs(np.fft.rfft(frames, axis=1)) ** 2 @ _filters(window, sample_rate)
    log = np.log(np.maximum(power, 1e-9))
    log = np.maximum(log, log.max() - _FLOOR)
    return np.asarray((log - log.mean(axis=0)) / (log.std(axis=0) + 1e-6))


@cache
def _filters(window: int, sample_rate: int) -> Array:
    """Return triangular filters (frequencies, bands), evenly spaced in mel."""
    frequencies = np.fft.rfftfreq(window, 1.0 / sample_rate)
    low, high = (2595.0 * np.log10(1.0 + f / 700.0) for f in (_LOWEST, min(_HIGHEST, 0.5 * sample_rate)))
    edges = 700.0 * (10.0 ** (np.linspace(low, high, _BANDS + 2) / 2595.0) - 1.0)
    rise = (frequencies[:, None] - edges[:-2]) / (edges[1:-1] - edges[:-2])
    fall = (edges[2:] - frequencies[:, None]) / (edges[2:] - edges[1:-1])
    return np.asarray(np.maximum(np.minimum(rise, fall), 0.0))
