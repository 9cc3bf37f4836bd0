"""The video encoder, which a worker (`machine.workers`) runs: pictures and sound in, a film out (`codecs`).

A process of its own because the encoder's library brings GPL code, may crash, and should work while the next
picture is drawn. A picture's bytes stand in memory that both processes map (`slots`).
"""

from __future__ import annotations

import atexit
from contextlib import suppress
from fractions import Fraction
from functools import cache
from pathlib import Path

import av
import numpy as np
import numpy.typing as npt
from av.video.reformatter import VideoReformatter

from .codecs import CODECS, Codec
from .setup import SLOTS, FilmSetup
from .slots import map_slots

# The same number on every machine: the encoder's output depends on it.
THREADS = 4
BT709 = 1
LIMITED_RANGE = 1
BITS_PER_SECOND = 96_000

Bytes = npt.NDArray[np.uint8]


class Film:
    """A film in the making: pictures at k/fps, sound from t = 0.

    If the process ends before the film does, its half-written file is removed.
    """

    def __init__(self, setup: FilmSetup) -> None:
        self._codec = codec = CODECS[setup.codec]
        self._options = {**codec.options, **(codec.draft_options if setup.draft else {})}
        self._slots = np.frombuffer(map_slots(setup.memory), np.uint8).reshape(SLOTS, -1)
        self._size = (setup.width, setup.height)
        self._given = setup.pixels
        alpha = codec.alpha_pixels if setup.pixels == "rgba" else None
        self._pixels = alpha or codec.pixels
        self._fps = Fraction(setup.fps)
        self._pictures = 0
        self._reformat = VideoReformatter()
        self._path = setup.path
        atexit.register(self._remove)
        self._container = av.open(
            setup.path, "w", format=codec.container, options=dict(codec.container_options)
        )
        self._video = self._video_stream()
        self._sound = None if setup.sample_rate is None else Sound(self._container, setup.sample_rate, codec)

    def _video_stream(self) -> av.VideoStream:
        stream = self._container.add_stream(self._codec.video, rate=self._fps, options=self._options)
        stream.width, stream.height = self._size
        stream.pix_fmt = self._pixels
        context = stream.codec_context
        context.time_base = 1 / self._fps
        context.thread_count = THREADS
        context.colorspace = context.color_primaries = context.color_trc = BT709
        context.color_range = LIMITED_RANGE
        return stream

    def picture(self, number: int) -> None:
        """Add the next picture, which stands in the slot of that number."""
        frame = self._in_form(self._slots[number])
        # ProRes writes what each picture says of itself.
        frame.color_primaries = frame.color_trc = BT709
        frame.pts = self._pictures
        frame.time_base = 1 / self._fps
        self._pictures += 1
        self._container.mux(self._video.encode(frame))

    def _in_form(self, numbers: Bytes) -> av.VideoFrame:
        """Return a picture as the codec wants it."""
        width, height = self._size
        if self._given == self._pixels:
            frame = av.VideoFrame.from_ndarray(numbers.reshape(-1, width), format=self._given)
            frame.colorspace, frame.color_range = BT709, LIMITED_RANGE
            return frame
        return self._reformat.reformat(
            av.VideoFrame.from_ndarray(numbers.reshape(height, width, -1), format=self._given),
            format=self._pixels,
            dst_colorspace=BT709,
            src_color_range="JPEG",
            dst_color_range="MPEG",
            interpolation="BILINEAR",
        )

    def sound(self, data: bytes) -> None:
        """Add sound: 16-bit little-endian mono samples."""
        if self._sound is None:
            raise ValueError("sound came for a silent film")
        self._sound.add(np.frombuffer(data, "<i2").astype(np.int16, copy=False))

    def finish(self) -> None:
        """Encode what is still held back and complete the file."""
        self._container.mux(self._video.encode(None))
        if self._sound is not None:
            self._sound.finish()
        self._container.close()
        atexit.unregister(self._remove)

    def _remove(self) -> None:
        # The program died, and so cannot remove what is half written.
        with suppress(OSError):
            Path(self._path).unlink()


class Sound:
    """The sound of a film; its time is counted in samples, so that it cannot drift from the pictures."""

    def __init__(self, container: av.container.OutputContainer, rate: int, codec: Codec) -> None:
        self._container = container
        self._time_base = Fraction(1, rate)
        self._rate = rate
        self._samples = 0
        rates = codec.rates or (rate,)
        encoded = next((supported for supported in rates if supported >= rate), rates[-1])
        self._stream = container.add_stream(codec.sound, rate=encoded, layout="mono")
        if codec.rates:
            self._stream.bit_rate = BITS_PER_SECOND

    def add(self, samples: npt.NDArray[np.int16]) -> None:
        """Encode the next samples, shape (n,)."""
        frame = av.AudioFrame.from_ndarray(samples[None], format="s16", layout="mono")
        frame.sample_rate = self._rate
        frame.pts = self._samples
        frame.time_base = self._time_base
        self._samples += len(samples)
        self._container.mux(self._stream.encode(frame))

    def finish(self) -> None:
        """Encode what is still held back."""
        self._container.mux(self._stream.encode(None))


def encode(setup: FilmSetup, what: str, *arguments: int | bytes) -> tuple[str, int | None] | None:
    """Do a step of a film: "open" it, add a "picture" or "sound", or "finish" it.

    Returns None, or what went wrong and the number of the system's error, if it is one.
    """
    try:
        film = _film(setup)
        if what != "open":
            getattr(film, what)(*arguments)
    except Exception as error:
        text = getattr(error, "strerror", None) or str(error) or type(error).__name__
        return text, getattr(error, "errno", None)
    return None


@cache
def _film(setup: FilmSetup) -> Film:
    return Film(setup)
