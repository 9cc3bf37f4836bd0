"""Sound as bytes, in the encodings in which speech services send it, to samples."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..core.arrays import Int16Array
from ..core.speech.audio import Samples
from ..errors import InputError, unknown

_FULL_SCALE = 32_767


def _linear(data: bytes) -> Samples:
    return np.frombuffer(data, "<i2").astype(np.int16)


def _floats(data: bytes) -> Samples:
    floats = np.nan_to_num(np.frombuffer(data, "<f4"), nan=0.0, posinf=1.0, neginf=-1.0)
    samples: Samples = np.round(np.clip(floats, -1.0, 1.0) * _FULL_SCALE).astype(np.int16)
    return samples


def _mu_law() -> Int16Array:
    """Return the samples (256,) of G.711's mu-law codes: sign, 3 bits exponent, 4 mantissa, all inverted."""
    code = ~np.arange(256, dtype=np.uint8)
    exponent, mantissa = (code >> 4 & 7).astype(int), (code & 15).astype(int)
    size = ((2 * mantissa + 33 << exponent) - 33) * 4
    table: Int16Array = np.where(code & 128, -size, size).astype(np.int16)
    return table


def _a_law() -> Int16Array:
    """Return the samples (256,) of G.711's A-law codes: as mu-law, with every other bit inverted."""
    code = np.arange(256, dtype=np.uint8) ^ 0x55
    exponent, mantissa = (code >> 4 & 7).astype(int), (code & 15).astype(int)
    size = np.where(exponent, 2 * mantissa + 33 << np.maximum(exponent - 1, 0), 2 * mantissa + 1) * 8
    table: Int16Array = np.where(code & 128, size, -size).astype(np.int16)
    return table


def _by(table: Int16Array) -> Callable[[bytes], Samples]:
    return lambda data: table[np.frombuffer(data, np.uint8)]


_DECODERS: Mapping[str, tuple[int, Callable[[bytes], Samples]]] = {
    "pcm_s16le": (2, _linear),
    "pcm_f32le": (4, _floats),
    "pcm_mulaw": (1, _by(_mu_law())),
    "pcm_alaw": (1, _by(_a_law())),
}
ENCODINGS = tuple(_DECODERS)
"""The encodings, as FFmpeg names them; G.711's are of 8 bits."""


def sample_bytes(encoding: str) -> int:
    """Return how many bytes a sample has; raise InputError for an unknown encoding."""
    if encoding not in _DECODERS:
        raise InputError(unknown("encoding", encoding, ENCODINGS))
    return _DECODERS[encoding][0]


class PcmDecoder:
    """Decodes one channel of sound from bytes that are cut anywhere."""

    def __init__(self, encoding: str) -> None:
        """Raise InputError for an unknown encoding."""
        self._size = sample_bytes(encoding)
        self.encoding, self._decode = encoding, _DECODERS[encoding][1]
        self._rest = b""

    def decode(self, data: bytes) -> Samples:
        """Return the samples that are whole now, int16, shape (n,)."""
        data = self._rest + data
        whole = len(data) // self._size * self._size
        self._rest = data[whole:]
        return self._decode(data[:whole])


def samples_of(values: ArrayLike) -> Samples:
    """Return one channel of sound, int16 or floats in -1..1, as int16 samples, shape (n,).

    Raises InputError for anything else.
    """
    try:
        sound = np.asarray(values)
    except ValueError:
        sound = np.zeros((1, 1))
    if sound.ndim != 1 or (sound.dtype != np.int16 and sound.dtype.kind != "f"):
        raise InputError(
            f"sound is {sound.dtype} in {sound.ndim} dimensions; expected one channel of int16, or -1..1"
        )
    if sound.dtype == np.int16:
        return sound
    if not np.all(np.abs(sound) <= 1.0):
        raise InputError("sound beyond -1..1; expected int16, or floats from -1 to 1")
    samples: Samples = np.round(sound * _FULL_SCALE).astype(np.int16)
    return samples


def check_rate(rate: int, low: int, high: int) -> None:
    """Raise InputError unless `rate` is a sample rate in Hz from `low` to `high`."""
    if isinstance(rate, bool) or not isinstance(rate, int) or not low <= rate <= high:
        raise InputError(f"sample rate {rate!r}; expected {low:,} to {high:,} Hz, a whole number")
