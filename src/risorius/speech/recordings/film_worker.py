"""The decoder of films' sound, which a worker (`machine.workers`) runs.

A process of its own because the decoder's library brings GPL code and may crash. It imports nothing of
Risorius.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import IO

import av
import numpy as np


class NoSoundError(Exception):
    """The file has no sound."""


class UnknownSoundError(Exception):
    """The file's sound is of a kind that the library does not know."""


def decode(tell: Callable[[int | bytes], object], file: IO[bytes], container: str) -> None:
    """Tell the sample rate of a file's first sound, then its blocks. `container`: `mov`, `matroska` ….

    A block's bytes are samples (32-bit float, little-endian) of which the channels are averaged.

    The container is told by the file's first bytes and is not left to the library, some of whose formats open
    other files and addresses.
    """
    with av.open(file, "r", format=container, metadata_errors="ignore") as film:
        if not film.streams.audio:
            raise NoSoundError("has no sound")
        stream = film.streams.audio[0]
        if stream.codec_context is None:
            raise UnknownSoundError("its sound is of an unknown kind")
        tell(stream.rate)
        resampler = av.AudioResampler(format="fltp", rate=stream.rate)
        for frame in film.decode(stream):
            for plain in resampler.resample(frame):
                samples = plain.to_ndarray().mean(axis=0, dtype=np.float32)
                tell(samples.astype("<f4", copy=False).tobytes())


def read(tell: Callable[[int | bytes], object], path: str, container: str) -> tuple[str, bool] | None:
    """Decode a file as `decode` does. Returns None, or what went wrong and whether the file has no sound."""
    try:
        with Path(path).open("rb") as file:
            decode(tell, file, container)
    except Exception as error:
        text = getattr(error, "strerror", None) or str(error) or type(error).__name__
        return text, isinstance(error, NoSoundError)
    return None
