"""The transition of a face from one stretch to the next without a jump."""

from __future__ import annotations

from fractions import Fraction
from math import ceil

import numpy as np

from ..core.arrays import Array
from ..core.parameters import PARAMETERS
from ..face.fit.expressions import emotion_presets

CROSSFADE = 0.15
"""Seconds in which the face passes from one stretch to the next: an interrupted mouth shuts within .2 s."""
_LOW, _HIGH = np.array([(p.low, p.high) for p in PARAMETERS]).T


class CrossFade:
    """The last change of the playback, and the difference that it left."""

    def __init__(self, fps: Fraction) -> None:
        self._fps = fps
        self._from: Array | None = None
        self._at = 0
        self._emotion: Array = np.zeros(len(emotion_presets()))

    def start(self, last: Array | None, frame: int) -> None:
        """Leave the values (parameters,) of the frame shown last, from `frame` on."""
        self._from, self._at = None if last is None else last[None], frame

    def follow(self, last: Array, coming: Array, frame: int) -> None:
        """Go on by `coming` (frames, parameters), which begins at the frame before, shown as `last`.

        The difference fades: nothing is blended where they agree.
        """
        coming = coming[: ceil(CROSSFADE * self._fps) + 1]
        self._from, self._at = np.clip(coming[1:] + (last - coming[0]), _LOW, _HIGH), frame

    def blended(self, values: Array, frame: int) -> Array:
        """Return a frame's values as they are shown."""
        since = frame - self._at
        share = float((since + 1) / self._fps) / CROSSFADE
        if self._from is None or share >= 1.0:
            return values
        weight = share * share * (3.0 - 2.0 * share)
        before = self._from[min(since, len(self._from) - 1)]
        blended: Array = before + weight * (values - before)
        return blended

    def approached(self, emotion: Array) -> Array:
        """Return a frame's presets of emotion (4,), which pass to the next stretch as fast as the face."""
        most = float(1 / self._fps) / CROSSFADE
        self._emotion = self._emotion + np.clip(emotion - self._emotion, -most, most)
        return self._emotion
