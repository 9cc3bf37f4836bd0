"""Pitch that was measured before: a text that grows is measured only where it has grown."""

from __future__ import annotations

from collections import OrderedDict
from hashlib import blake2b
from math import ceil
from threading import Lock

import numpy as np

from ...core.speech.audio import Audio
from ..resampled import Resampled
from .pitch import Pitch, measure_pitch
from .running import RunningRange

# Seconds after a run that its measurement may hear: half a window, the longest period, and the filters.
_BEYOND = 0.1


class PitchCache:
    """Keeps the pitch of the latest `most` runs; one of 10 s takes 8 kB."""

    def __init__(self, most: int = 256) -> None:
        self._most = most
        self._sound: SoundDigest | None = None
        self._pitch: OrderedDict[bytes, Pitch] = OrderedDict()
        self._lock = Lock()

    def __len__(self) -> int:
        return len(self._pitch)

    def measure(self, resampled: Resampled, start: float, end: float, speaker: RunningRange) -> Pitch:
        """Return the result of `measure_pitch`."""
        with self._lock:
            key = self._key(resampled.audio, start, end, speaker)
            pitch = self._pitch.pop(key, None)
        if pitch is None:
            pitch = measure_pitch(resampled, start, end, speaker)
            pitch.hertz.setflags(write=False)
        with self._lock:
            self._pitch[key] = pitch
            while len(self._pitch) > self._most:
                self._pitch.popitem(last=False)
        return pitch

    def _key(self, audio: Audio, start: float, end: float, speaker: RunningRange) -> bytes:
        """Return a digest of all that a measurement depends on: the sound up to the end, and the speaker."""
        samples = ceil((end + _BEYOND) * audio.sample_rate)
        if self._sound is None or not self._sound.reaches(audio, samples):
            self._sound = SoundDigest(audio)
        sound = self._sound.up_to(samples)
        return sound + repr((audio.sample_rate, start, end, speaker.state)).encode()


class SoundDigest:
    """Digests of a sound up to ever later samples: it is read once, however many runs are measured in it."""

    def __init__(self, audio: Audio) -> None:
        self._audio, self._blocks = audio, audio.blocks()
        self._digest = blake2b(digest_size=32)
        self._read = 0
        self._block = np.zeros(0, np.int16)

    def reaches(self, audio: Audio, samples: int) -> bool:
        """Tell whether it can digest this sound up to `samples`."""
        return audio is self._audio and samples >= self._read

    def up_to(self, samples: int) -> bytes:
        """Return the digest of the first `samples`, or of all of them; at least as many as last time."""
        while self._read < samples:
            if not len(self._block):
                following = next(self._blocks, None)
                if following is None:
                    break
                self._block = following
            part, self._block = np.split(self._block, [samples - self._read])
            self._digest.update(part.tobytes())
            self._read += len(part)
        return self._digest.digest()
