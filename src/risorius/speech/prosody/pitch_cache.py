"""Pitch that was measured before: a text that grows is measured only where it has grown."""

from __future__ import annotations

from collections import OrderedDict
from hashlib import blake2b
from math import ceil
from threading import Lock

from ...core.audio import Audio
from ..recordings.resampled import Resampled
from .pitch import Pitch, measure_pitch
from .running import RunningRange

# Seconds after a run that its measurement may hear: half a window, the longest period, and the filters.
_BEYOND = 0.1


class PitchCache:
    """Keeps the pitch of the latest `most` runs; one of 10 s takes 8 kB."""

    def __init__(self, most: int = 256) -> None:
        self._most = most
        self._pitch: OrderedDict[bytes, Pitch] = OrderedDict()
        self._lock = Lock()

    def __len__(self) -> int:
        return len(self._pitch)

    def measure(self, resampled: Resampled, start: float, end: float, speaker: RunningRange) -> Pitch:
        """Return what `measure_pitch` does."""
        key = _key(resampled.audio, start, end, speaker)
        with self._lock:
            pitch = self._pitch.pop(key, None)
        if pitch is None:
            pitch = measure_pitch(resampled, start, end, speaker)
            pitch.hertz.setflags(write=False)
        with self._lock:
            self._pitch[key] = pitch
            while len(self._pitch) > self._most:
                self._pitch.popitem(last=False)
        return pitch


def _key(audio: Audio, start: float, end: float, speaker: RunningRange) -> bytes:
    """Return a digest of all that a measurement depends on: the sound up to the end, and who speaks."""
    digest = blake2b(repr((audio.sample_rate, start, end, speaker.state)).encode(), digest_size=32)
    left = ceil((end + _BEYOND) * audio.sample_rate)
    for block in audio.blocks():
        digest.update(block[:left].tobytes())
        left -= len(block)
        if left <= 0:
            break
    return digest.digest()
