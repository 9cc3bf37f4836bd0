"""Find in the sound itself the times at which espeak-ng's phones begin.

A stop is stamped at its burst: its closure is the silence before. A vowel after a nasal is stamped some 25 ms
after the mouth has opened: the opening is where the sound suddenly grows louder. Both measured on the en-us
voice at 175 words per minute, where closures last 39 to 49 ms; at higher rates they are shorter.
"""

from __future__ import annotations

import numpy as np

from ...core.speech.audio import Samples

WORDS_PER_MINUTE = 175
# Seconds at that rate.
USUAL_CLOSURE = 0.044
LONGEST_CLOSURE = 0.06
LATEST_STAMP = 0.045
# The opening of a nasal is at least so sudden: growth of the sound's power within 10 ms (16 dB measured).
OPENING_RATIO = 6.0
OPENING_WINDOW = 0.005


def tempo(rate: int | None) -> float:
    """Return the factor by which transitions are shorter at `rate` words per minute (None: the usual)."""
    return min(1.0, WORDS_PER_MINUTE / (rate or WORDS_PER_MINUTE))


def silence_before(samples: Samples, burst: int, longest: int) -> int:
    """Return how many samples before `burst` are exactly silent, `longest` at most."""
    before = samples[max(0, burst - longest) : burst]
    sounding = np.flatnonzero(before)
    return len(before) - (int(sounding[-1]) + 1 if sounding.size else 0)


def opening_before(samples: Samples, vowel: int, earliest: int, sample_rate: int) -> int:
    """Return where in [earliest, vowel] the sound grows most suddenly; `vowel` if nowhere suddenly enough."""
    window = round(OPENING_WINDOW * sample_rate)
    first = max(0, earliest - window)
    # The difference of neighbouring samples brings out the higher formants, which a closed mouth damps.
    slope = np.diff(samples[first : vowel + window + 1].astype(np.float64))
    power = np.concatenate(([0.0], np.cumsum(slope**2)))
    at = np.arange(earliest - first, vowel - first + 1)
    at = at[(at >= window) & (at + window < len(power))]
    if not at.size:
        return vowel
    before = power[at] - power[at - window]
    after = power[at + window] - power[at]
    ratio = after / (before + window)
    best = int(np.argmax(ratio))
    return first + int(at[best]) if ratio[best] >= OPENING_RATIO else vowel
