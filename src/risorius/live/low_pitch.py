"""Stretches of low pitch in the other's speech: there people answer "uh-huh" (Ward and Tsukahara 2000).

Pitch is found as YIN finds it (de Cheveigné and Kawahara 2002), block by block, without looking ahead.
"""

from __future__ import annotations

from collections import deque

import numpy as np

from ..core.arrays import Array

# Hz: the rate near which pitch is found, and where it may lie.
_RATE, _LOWEST, _HIGHEST = 8_000, 60.0, 500.0
# The depth of a period's minimum in a voiced block.
_VOICED = 0.2
# Ward and Tsukahara 2000: pitch below its 26th percentile, for at least 110 ms.
PERCENTILE, LASTING = 26.0, 0.11
# Seconds of voice from which on the percentile is known, of voice that it is taken from, and without voice
# that end a stretch (the first two are ours).
_KNOWN, _MEMORY, _GAP = 1.5, 30.0, 0.06


class LowPitch:
    """Tells when a stretch of low pitch has lasted long enough, from blocks of sound of `seconds` each."""

    def __init__(self, seconds: float) -> None:
        self._seconds = seconds
        self._before = np.zeros(0)
        self._pitches: deque[float] = deque(maxlen=round(_MEMORY / seconds))
        self._low = self._gap = 0.0
        self._told = False

    def advance(self, block: Array, rate: int) -> bool:
        """Take in a block of samples -1..1; return whether the stretch that it lies in is low from now on."""
        step = max(1, rate // _RATE)
        sound = block[: len(block) // step * step].reshape(-1, step).mean(axis=1)
        both = np.concatenate([self._before, sound])
        self._before = sound
        hertz = pitch_of(both, rate / step) if len(both) == 2 * len(sound) else 0.0
        if not hertz:
            self._gap += self._seconds
            if self._gap > _GAP:
                self._end()
            return False
        self._gap = 0.0
        self._pitches.append(hertz)
        if len(self._pitches) * self._seconds < _KNOWN or hertz >= np.percentile(self._pitches, PERCENTILE):
            self._end()
            return False
        self._low += self._seconds
        if self._told or self._low < LASTING:
            return False
        self._told = True
        return True

    def _end(self) -> None:
        self._low, self._told = 0.0, False


def pitch_of(sound: Array, rate: float) -> float:
    """Return the pitch in Hz of two blocks of sound (n,), 0 if they have none."""
    size, longest = len(sound) // 2, min(int(rate / _LOWEST), len(sound) // 2 - 1)
    rows = np.lib.stride_tricks.sliding_window_view(sound - sound.mean(), size)[: longest + 1]
    difference = ((rows - rows[0]) ** 2).sum(axis=1)[1:]
    normalised = difference / (np.cumsum(difference) / np.arange(1, longest + 1) + 1e-9)
    first = int(rate / _HIGHEST)
    deep = np.flatnonzero(normalised[first:] < _VOICED)
    if not len(deep):
        return 0.0
    lag = first + int(deep[0])
    while lag + 1 < longest and normalised[lag + 1] < normalised[lag]:
        lag += 1
    return rate / (lag + 1)
