"""Sound stretched in time without a change of pitch: WSOLA (Verhelst and Roelands 1993)."""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array
from ...core.speech.audio import Samples

# Seconds: of a window, and how far around its place the best match is sought.
WINDOW, SEARCH = 0.024, 0.006


def stretch(samples: Samples, source: Array, target: Array, sample_rate: int) -> Samples:
    """Return the sound whose moment `target[k]` is moment `source[k]` of `samples`; both count samples.

    It lasts from `target[0]` to `target[-1]`; between the given moments time runs evenly.
    """
    length = round(float(target[-1] - target[0]))
    half = max(round(0.5 * WINDOW * sample_rate), 1)
    reach = round(SEARCH * sample_rate)
    window = np.hanning(2 * half + 1)[:-1]
    padding = 2 * half + reach
    sound = np.pad(samples.astype(np.float64), padding)
    out = np.zeros(length + 3 * half)
    weight = np.zeros(length + 3 * half)
    follows: int | None = None
    for at in range(0, length + half, half):
        target_sample = padding + round(float(np.interp(target[0] + at, target, source)))
        start = _best(sound, target_sample - half, follows, half, reach)
        out[at : at + 2 * half] += window * sound[start : start + 2 * half]
        weight[at : at + 2 * half] += window
        follows = start + half
    stretched = out[half : half + length] / np.maximum(weight[half : half + length], 1e-3)
    return np.clip(np.round(stretched), -32768, 32767).astype(np.int16)


def _best(sound: Array, start: int, follows: int | None, half: int, reach: int) -> int:
    """Return where near `start` a window best continues the one before it, which goes on at `follows`."""
    start = max(0, min(start, len(sound) - 2 * half))
    if follows is None or follows + 2 * half > len(sound):
        return start
    first = max(0, start - reach)
    last = min(start + reach, len(sound) - 2 * half)
    going_on = sound[follows : follows + 2 * half]
    around = sound[first : last + 2 * half]
    likeness = np.correlate(around, going_on, "valid")
    squares = np.cumsum(np.concatenate(([0.0], around**2)))
    energy = squares[2 * half :] - squares[: len(squares) - 2 * half]
    return first + int(np.argmax(likeness / np.sqrt(energy + 1.0)))
