"""The tune of an utterance: pitch in semitones without the voice's gaps and the consonants' ripples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import median_filter, uniform_filter1d

from ...core.arrays import Array, BoolArray
from .pitch import STEP, Pitch

# Frames: a median against single slips, then a mean.
_MEDIAN, _MEAN = 5, 5
# The speaker's floor and ceiling: percentiles of what is voiced, and the least semitones between them.
_FLOOR, _CEILING, _LEAST_RANGE = 5.0, 95.0, 4.0


@dataclass(frozen=True, slots=True)
class Contour:
    """Semitones above the speaker's floor every STEP seconds, bridged over what has no voice; shape
    (frames,).

    `voiced` tells where there is. `span`: semitones from floor to ceiling.
    """

    semitones: Array
    voiced: BoolArray
    span: float

    def within(self, start: float, end: float) -> Array:
        """Return the values in [start, end] seconds, at least one."""
        first = min(max(round(start / STEP), 0), len(self.semitones) - 1)
        return self.semitones[first : max(round(end / STEP) + 1, first + 1)]

    def at(self, time: float) -> float:
        """Return the value at `time` seconds."""
        return float(self.within(time, time)[0])

    def share(self, semitones: float) -> float:
        """Return where a value lies between floor (0) and ceiling (1)."""
        return semitones / self.span

    def is_voiced(self, start: float, end: float) -> bool:
        """Tell whether there is some voice in [start, end] seconds."""
        return bool(self.voiced[max(round(start / STEP), 0) : round(end / STEP) + 1].any())


def contour_of(pitch: Pitch) -> Contour | None:
    """Return the tune; None where nothing is voiced."""
    raw = pitch.semitones
    voiced = np.isfinite(raw)
    if not voiced.any():
        return None
    frames = np.arange(len(raw))
    bridged = np.interp(frames, frames[voiced], raw[voiced])
    smooth = uniform_filter1d(median_filter(bridged, _MEDIAN, mode="nearest"), _MEAN, mode="nearest")
    floor, ceiling = np.percentile(smooth[voiced], [_FLOOR, _CEILING])
    return Contour(smooth - floor, voiced, max(float(ceiling - floor), _LEAST_RANGE))
