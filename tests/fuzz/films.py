"""Films, decoded in a process of their own as in the program, but one for all: to start one takes seconds."""

from __future__ import annotations

import multiprocessing
import tempfile
from concurrent.futures import ProcessPoolExecutor, TimeoutError
from concurrent.futures.process import BrokenProcessPool
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np

from risorius.errors import InputError
from risorius.script.suffixes import RECORDING_SUFFIXES
from risorius.speech.recordings.film_sound import container_of

from .registry import register

PATIENCE = 20.0
FILMS = {"m4a": "aac", "mp4": "aac", "mov": "pcm_s16le", "webm": "libopus", "mkv": "flac", "aac": "aac"}
_MOST = 50_000_000  # bytes of sound that a spoilt film may come to


class _Told:
    """What the decoder tells: the sample rate, and samples that are counted."""

    def __init__(self) -> None:
        self.size, self.rate = 0, 0

    def __call__(self, item: int | bytes) -> None:
        if isinstance(item, int):
            self.rate = item
        else:
            self.size += len(item)
        if self.size > _MOST:
            raise BrokenPipeError


def _decoded(path: str, container: str) -> tuple[str, int]:
    """Return what is wrong with a film, "" if nothing is, and the sample rate that was told."""

    import av

    from risorius.speech.recordings.film_worker import NoSoundError, UnknownSoundError, decode

    told = _Told()
    with Path(path).open("rb") as file:
        try:
            decode(told, file, container)
        except (av.FFmpegError, BrokenPipeError, NoSoundError, UnknownSoundError) as error:
            return str(error) or type(error).__name__, told.rate
    return "", told.rate


@cache
def _process() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, multiprocessing.get_context("spawn"))


def _film(path: Path) -> None:
    with path.open("rb") as file:
        container = container_of(file.read(16))
    if container is None:
        raise InputError("is not a film")
    try:
        fault, rate = _process().submit(_decoded, str(path), container).result(PATIENCE)
    except BrokenProcessPool:
        _process.cache_clear()
        raise InputError("the decoder died") from None
    except TimeoutError:
        raise RuntimeError("the decoder hangs") from None
    if fault:
        raise InputError(fault)
    assert rate > 0


def _sample(suffix: str, codec: str) -> bytes:
    import av

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"a.{suffix}"
        with av.open(str(path), "w") as container:
            stream = container.add_stream(codec, rate=48_000, layout="mono")
            sound = (9_000 * np.sin(np.arange(9600) / 30.0)).astype(np.int16)
            frame = av.AudioFrame.from_ndarray(sound.reshape(1, -1), format="s16", layout="mono")
            frame.sample_rate, frame.time_base, frame.pts = 48_000, Fraction(1, 48_000), 0
            container.mux(stream.encode(frame))
            container.mux(stream.encode(None))
        return path.read_bytes()


@cache
def _samples() -> dict[str, bytes]:
    """Return a film of each container, made in the other process: this one loads no decoder."""
    return _process().submit(_all_samples).result()


def _all_samples() -> dict[str, bytes]:
    return {suffix: _sample(suffix, codec) for suffix, codec in FILMS.items()}


for _suffix in FILMS:
    assert f".{_suffix}" in RECORDING_SUFFIXES
    register(f".{_suffix}", _film, lambda suffix=_suffix: _samples()[suffix], share=0.3)  # type: ignore[misc]
