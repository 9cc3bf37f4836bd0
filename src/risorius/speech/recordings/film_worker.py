"""The decoder of films' sound, which a worker (`machine.workers`) runs.

A process of its own because the decoder's library brings GPL code and may crash. It imports nothing of
Risorius.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO, Any

import av
import numpy as np
import numpy.typing as npt


class NoSoundError(Exception):
    """The file has no sound."""


class UnknownSoundError(Exception):
    """The file's sound is of a kind that the library does not know."""


def decode(tell: Callable[[int | bytes], object], file: IO[bytes], container: str) -> None:
    """Tell the sample rate of a file's first sound, then its blocks. `container`: `mov`, `matroska` ….

    A block's bytes are samples (32-bit float, little-endian), channels made one (`mixdown`).

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
        mixdown = _mixdown()
        for block in _seconds(film, stream):
            tell(mixdown.mono(block).astype("<f4", copy=False).tobytes())


def _seconds(film: Any, stream: Any) -> Iterator[npt.NDArray[np.float32]]:
    """Yield the sound in blocks (n, channels) of at least a second, but for the last."""
    resampler = av.AudioResampler(format="fltp", rate=stream.rate)
    waiting: list[npt.NDArray[np.float32]] = []
    count = 0
    try:
        for frame in film.decode(stream):
            for plain in resampler.resample(frame):
                samples = plain.to_ndarray().T
                if waiting and samples.shape[1] != waiting[0].shape[1]:
                    yield np.concatenate(waiting)
                    waiting, count = [], 0
                waiting.append(samples)
                count += len(samples)
            if count >= stream.rate:
                yield np.concatenate(waiting)
                waiting, count = [], 0
    finally:  # what has been decoded before the fault, if there is one
        if waiting:
            yield np.concatenate(waiting)


def _mixdown() -> Any:
    """Return how channels are made one: the module beside this one, without all of Risorius."""
    spec = importlib.util.spec_from_file_location("mixdown", Path(__file__).with_name("mixdown.py"))
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Mixdown()


def read(tell: Callable[[int | bytes], object], path: str, container: str) -> tuple[str, bool] | None:
    """Decode a file as `decode` does. Returns None, or what went wrong and whether the file has no sound."""
    try:
        with Path(path).open("rb") as file:
            decode(tell, file, container)
    except Exception as error:
        text = getattr(error, "strerror", None) or str(error) or type(error).__name__
        return text, isinstance(error, NoSoundError)
    return None
