"""The decoder of films' sound, which a worker (`machine.workers`) runs.

A process of its own because the decoder's library brings GPL code and may crash. It imports nothing of
Risorius.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from pathlib import Path
from typing import IO, Any

import av
import numpy as np
import numpy.typing as npt
from av.stream import Disposition

_MOST_DAMAGED = 0.05  # share of the packets: at a joint of two files one may be


class NoSoundError(Exception):
    """The file has no sound."""


class UnknownSoundError(Exception):
    """The file's sound is of a kind that the library does not know."""


class DamagedSoundError(Exception):
    """Too many packets of the file's sound cannot be decoded."""


def decode(
    tell: Callable[[int | float | bytes], object],
    file: IO[bytes],
    container: str,
    rate: int = 0,
    patient: bool = False,
) -> None:
    """Tell the sample rate of a file's first sound, then its blocks. `container`: `mov`, `matroska` ….

    A block's bytes are samples (32-bit float, little-endian), channels made one (`mixdown`). If the sound
    begins after the picture, the seconds between them are told before the first block. `rate`: the sample
    rate to be told, 0 for the sound's own. `patient`: single packets that cannot be decoded are left out.

    The container is told by the file's first bytes and is not left to the library, some of whose formats open
    other files and addresses.
    """
    with av.open(file, "r", format=container, metadata_errors="ignore") as film:
        if not film.streams.audio:
            raise NoSoundError("has no sound")
        stream = film.streams.audio[0]
        if stream.codec_context is None:
            raise UnknownSoundError("its sound is of an unknown kind")
        rate = rate or stream.rate
        tell(rate)
        frames = iter(_patiently(film, stream) if patient else film.decode(stream))
        first = next(frames, None)
        if first is None:
            return
        if (late := _seconds_late(film, first)) > 0.0:
            tell(late)
        mixdown = _mixdown()
        for block in _seconds(chain([first], frames), rate):
            tell(mixdown.mono(block).astype("<f4", copy=False).tobytes())


def _seconds_late(film: Any, first: Any) -> float:
    """Return how much later than the picture the first frame of the sound begins, in seconds.

    Without a picture it is 0: then the first time stamp tells nothing, as in MP3.
    """
    starts = [
        float(stream.start_time * stream.time_base)
        for stream in film.streams.video
        if stream.start_time is not None and not stream.disposition & Disposition.attached_pic
    ]
    return first.time - min(starts) if starts and first.time is not None else 0.0


def _patiently(film: Any, stream: Any) -> Iterator[Any]:
    """Yield the frames of all packets that can be decoded; raise DamagedSoundError if many cannot."""
    packets = damaged = 0
    for packet in film.demux(stream):
        packets += 1
        try:
            yield from packet.decode()
        except av.error.InvalidDataError:
            damaged += 1
    if damaged > _MOST_DAMAGED * packets:
        raise DamagedSoundError(f"{damaged} of {packets} packets are damaged")


def _seconds(frames: Iterable[Any], rate: int) -> Iterator[npt.NDArray[np.float32]]:
    """Yield the sound in blocks (n, channels) of at least a second, but for the last."""
    waiting: list[npt.NDArray[np.float32]] = []
    count = 0
    try:
        for samples in _plain(frames, rate):
            if waiting and samples.shape[1] != waiting[0].shape[1]:
                yield np.concatenate(waiting)
                waiting, count = [], 0
            waiting.append(samples)
            count += len(samples)
            if count >= rate:
                yield np.concatenate(waiting)
                waiting, count = [], 0
    finally:  # what has been decoded before the fault, if there is one
        if waiting:
            yield np.concatenate(waiting)


def _plain(frames: Iterable[Any], rate: int) -> Iterator[npt.NDArray[np.float32]]:
    """Yield the samples (n, channels) of frames, of which joined files may have several kinds."""
    resamplers: dict[tuple[str, str, int], av.AudioResampler] = {}
    for frame in frames:
        kind = frame.format.name, frame.layout.name, frame.sample_rate
        if kind not in resamplers:
            resamplers[kind] = av.AudioResampler(format="fltp", rate=rate)
        for plain in resamplers[kind].resample(frame):
            yield plain.to_ndarray().T


def _mixdown() -> Any:
    """Return how channels are made one: the module beside this one, without all of Risorius."""
    spec = importlib.util.spec_from_file_location("mixdown", Path(__file__).with_name("mixdown.py"))
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.Mixdown()


def read(
    tell: Callable[[int | float | bytes], object],
    path: str,
    container: str,
    rate: int = 0,
    patient: bool = False,
) -> tuple[str, bool] | None:
    """Decode a file as `decode` does. Returns None, or what went wrong and whether the file has no sound."""
    try:
        with Path(path).open("rb") as file:
            decode(tell, file, container, rate, patient)
    except Exception as error:
        text = getattr(error, "strerror", None) or str(error) or type(error).__name__
        return text, isinstance(error, NoSoundError)
    return None
