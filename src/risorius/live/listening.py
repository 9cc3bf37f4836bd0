"""Times at which a listener nods: at the speaker's pauses, and after low pitch."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import Array
from ..core.parameters import INDEX
from .low_pitch import LowPitch
from .pcm import check_rate, samples_of

# Seconds: of sound that is judged at once, of speech before a pause that is answered, of the pause until the
# answer, of a pause after which speech begins anew, and between two nods (ours: facts name no rate).
_BLOCK, SPEECH, PAUSE, LONG_PAUSE, BETWEEN = 0.02, 1.0, 0.2, 1.0, 2.0
# Seconds of speech before low pitch that is answered, and from then to the answer (Ward and Tsukahara 2000).
LOW_SPEECH, LOW_WAIT = 0.7, 0.7
# Decibels: the quietest sound that may be speech, and how far below the mean of speech a pause lies.
_QUIETEST, _DROP = -50.0, 20.0
# Share of a new block in the mean of speech: it follows in about a second.
_SHARE = 0.02
_RATES = (8_000, 192_000)
# Nods last 150 to 400 ms (Graf et al. 2002); degrees are ours. A nod goes down first.
NOD_SECONDS, NOD_DEGREES = 0.4, -5.0


class PauseListener:
    """Tells when to nod at the other's speech, from sound in pieces, cut anywhere."""

    def __init__(self) -> None:
        self._rest = np.zeros(0)
        self._rate = 0
        self._level: float | None = None
        self._speech = self._silence = 0.0
        self._since = BETWEEN
        self._low = LowPitch(_BLOCK)
        # Seconds until low pitch is answered.
        self._due: float | None = None

    def hear(self, samples: ArrayLike, rate: int) -> bool:
        """Hear samples, int16 or -1..1; return whether there is something in them at which to nod.

        Raises InputError, and hears nothing, if they are not one channel of sound at 8 to 192 kHz.
        """
        check_rate(rate, *_RATES)
        sound = samples_of(samples) / 32_768.0
        if rate != self._rate:
            self._rest, self._rate = np.zeros(0), rate
        sound = np.concatenate([self._rest, sound])
        size = round(rate * _BLOCK)
        blocks = sound[: len(sound) // size * size].reshape(-1, size)
        self._rest = sound[blocks.size :]
        levels = 10.0 * np.log10(np.mean(blocks**2, axis=1) + 1e-12)
        # Every block counts, those after a pause as well.
        nods = [self._advance(level, block) for level, block in zip(levels.tolist(), blocks, strict=True)]
        return any(nods)

    def _advance(self, level: float, block: Array) -> bool:
        self._since += _BLOCK
        is_low = self._low.advance(block, self._rate)
        if not (self._is_pause(level) or self._is_answer(is_low)):
            return False
        self._speech, self._since, self._due = 0.0, 0.0, None
        return True

    def _is_answer(self, is_low: bool) -> bool:
        """Tell whether low pitch is to be answered now."""
        if is_low and self._speech >= LOW_SPEECH:
            self._due = LOW_WAIT
        elif self._due is not None:
            self._due -= _BLOCK
        if self._due is None or self._due > 0.0:
            return False
        self._due = None
        return self._since >= BETWEEN

    def _is_pause(self, level: float) -> bool:
        threshold = _QUIETEST if self._level is None else max(_QUIETEST, self._level - _DROP)
        if level > threshold:
            self._level = level if self._level is None else self._level + _SHARE * (level - self._level)
            self._speech, self._silence = self._speech + _BLOCK, 0.0
            return False
        self._silence += _BLOCK
        if self._silence >= LONG_PAUSE:
            # The next speaker may be further away.
            self._level, self._speech = None, 0.0
        return self._silence >= PAUSE and self._speech >= SPEECH and self._since >= BETWEEN


def nod_pitch(seconds: float) -> float:
    """Return the degrees that a nod adds to the head's pitch `seconds` after it began."""
    if not 0.0 <= seconds < NOD_SECONDS:
        return 0.0
    return float(NOD_DEGREES * np.sin(np.pi * seconds / NOD_SECONDS) ** 2)


def nodded(values: Array, nod: float) -> Array:
    """Return the values of a frame with the head turned by a nod's degrees; the eyes stay where they look."""
    values = values.copy()
    values[INDEX["head_pitch"]] += nod
    values[INDEX["gaze_pitch"]] -= nod
    return values
