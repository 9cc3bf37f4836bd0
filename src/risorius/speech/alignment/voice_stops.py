"""Find stops of the voice between two sounds: glottal, or the closure between a hiss and a voiced sound.

It is found as a fall of the power where the voice is strong, and after a hiss also of the hiss.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, BoolArray, Int64Array
from ...languages.phonesets import HISSES
from .spectra import STEP, STEP_SECONDS, WINDOW

# Seconds before the sound after it in which a stop of the voice begins.
_BEFORE = 0.09
# One lasts 30 ms at least; windows of the spectra lie wholly inside for so long less their own length. A
# pulse of creak in it is seen for the length of a window.
_PULSE_STEPS = WINDOW // STEP
_SHORTEST_STEPS = round(0.03 / STEP_SECONDS) - _PULSE_STEPS
# The voice falls to a tenth of the next sound's amplitude in the lowest band, where nasals are nearly as
# strong as vowels; a hiss to a third of its own above 2.2 kHz. Natural logarithms of power as levels.
_VOICE_FALL, _HISS_FALL = np.log(100.0), np.log(10.0)
_VOICE, _HISS = 0, 7


def voice_stops(levels: Array, before: str, edges: Int64Array) -> tuple[int, int] | None:
    """Return the steps in which the voice stops before the sound between the last two of three `edges`.

    `before` is the phone between the first two. None if the voice does not stop.
    """
    first, edge, end = np.clip(edges, 0, len(levels)).tolist()
    if not first < edge < end:
        return None
    earliest = max(first, edge - round(_BEFORE / STEP_SECONDS))
    weak = levels[earliest:edge, _VOICE] < np.median(levels[edge:end, _VOICE]) - _VOICE_FALL
    if before in HISSES:
        hiss = levels[first:edge, _HISS:].mean(axis=1)
        weak &= hiss[earliest - first :] < np.median(hiss[: (len(hiss) + 1) // 2]) - _HISS_FALL
    # A stretch that is weak from the first step on is not a fall.
    falls = [fall for fall in _stretches(weak) if fall[0] > 0]
    return (earliest + falls[-1][0], earliest + falls[-1][1]) if falls else None


def _stretches(weak: BoolArray) -> list[tuple[int, int]]:
    """Return the first and last + 1 of the long stretches of weak steps, pulses within them included."""
    bounds = np.flatnonzero(np.diff(np.concatenate(([False], weak, [False])).astype(np.int8)))
    joined: list[tuple[int, int]] = []
    for first, last in bounds.reshape(-1, 2).tolist():
        if joined and first - joined[-1][1] <= _PULSE_STEPS:
            first = joined.pop()[0]
        joined.append((first, last))
    return [(first, last) for first, last in joined if last - first >= _SHORTEST_STEPS]
