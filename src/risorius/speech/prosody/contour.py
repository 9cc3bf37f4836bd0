"""The tune of a run: pitch in semitones without the voice's gaps and the consonants' ripples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, BoolArray
from ..filters import mean_of, median_of
from .pitch import STEP, Pitch
from .running import RunningRange

# Frames: a median against single slips, then a mean.
_MEDIAN, _MEAN = 5, 5
# The least semitones between the speaker's floor and ceiling.
_LEAST_RANGE = 4.0


@dataclass(frozen=True, slots=True)
class Contour:
    """Semitones above the speaker's floor every STEP seconds from frame `first` on, shape (frames,).

    They are bridged over what has no voice; `voiced` tells where there is. `floor`: semitones above 1 Hz;
    `span`: semitones from floor to ceiling.
    """

    first: int
    semitones: Array
    voiced: BoolArray
    floor: float
    span: float

    def within(self, start: float, end: float) -> Array:
        """Return the values in [start, end] seconds, at least one."""
        first = min(max(round(start / STEP) - self.first, 0), len(self.semitones) - 1)
        return self.semitones[first : max(round(end / STEP) - self.first + 1, first + 1)]

    def at(self, time: float) -> float:
        """Return the value at `time` seconds."""
        return float(self.within(time, time)[0])

    def share(self, semitones: float) -> float:
        """Return where a value lies between floor (0) and ceiling (1)."""
        return semitones / self.span

    def voiced_within(self, start: float, end: float) -> BoolArray:
        """Return which frames in [start, end] seconds have voice."""
        first = max(round(start / STEP) - self.first, 0)
        return self.voiced[first : max(round(end / STEP) - self.first + 1, 0)]

    def is_voiced(self, start: float, end: float) -> bool:
        """Tell whether there is some voice in [start, end] seconds."""
        return bool(self.voiced_within(start, end).any())


def contour_of(pitch: Pitch, speaker: RunningRange) -> Contour | None:
    """Return the tune, None if nothing is voiced; its frames are added to those of the speaker."""
    raw = pitch.semitones
    voiced = np.isfinite(raw)
    if not voiced.any():
        return None
    frames = np.arange(len(raw))
    bridged = np.interp(frames, frames[voiced], raw[voiced])
    smooth = mean_of(median_of(bridged, _MEDIAN), _MEAN)
    speaker.add(smooth[voiced])
    pitch_range = speaker.range
    span = max(pitch_range.high - pitch_range.low, _LEAST_RANGE)
    return Contour(pitch.first, smooth - pitch_range.low, voiced, pitch_range.low, span)
