"""The side of the video worker that gives it pictures and sound, and never waits for it without a limit."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from types import TracebackType

import numpy as np

from ...core.arrays import ByteArray, Int16Array
from ...errors import OutputError
from ...machine.workers import Worker, WorkerError
from ...render.yuv import planes
from .codecs import CODECS
from .setup import SLOTS, FilmSetup
from .slots import Slots

# Seconds without an answer after which the worker is given up.
PATIENCE = 60.0
_TASK = "risorius.ports.video.worker:encode"


class LostEncoderError(OutputError):
    """The worker died or did not answer: another one may do better."""


class VideoEncoder:
    """Writes one film through a worker process. Use as a context manager: leaving it completes the file.

    Pictures are handed over at once and encoded while the next one is made; at most a few wait. Raises
    LostEncoderError if the worker dies or does not answer for `patience` seconds, OutputError if it fails,
    and OSError for a fault of the disk.
    """

    def __init__(
        self,
        path: Path,
        size: tuple[int, int],
        fps: Fraction,
        sample_rate: int | None = None,
        patience: float = PATIENCE,
        *,
        codec: str = "mp4",
        channels: int = 3,
        draft: bool = False,
    ) -> None:
        self._shape = (size[1], size[0], channels)
        width, height = size[0] + size[0] % 2, size[1] + size[1] % 2
        pixels = "rgba" if channels == 4 else "rgb24"
        self._as_planes = channels == 3 and CODECS[codec].pixels == "yuv420p"
        if self._as_planes:
            pixels = "yuv420p"
        size_in_bytes = width * height * 3 // 2 if self._as_planes else width * height * channels
        self._patience, self._pictures, self._unanswered = patience, 0, 0
        self._slots = Slots(SLOTS, size_in_bytes)
        place, memory = str(path.absolute()), str(self._slots.path)
        self._setup = FilmSetup(place, width, height, str(fps), sample_rate, codec, pixels, memory, draft)
        try:
            with _lost():
                self._worker = Worker()
        except BaseException:
            self._slots.close()
            raise

    @property
    def pid(self) -> int:
        """The worker's process id."""
        return self._worker.pid

    def picture(self, rgb: ByteArray) -> None:
        """Add the next picture, uint8 of shape (height, width, channels); it may be changed afterwards."""
        if rgb.shape != self._shape or rgb.dtype != np.uint8:
            raise ValueError(f"a picture is {rgb.dtype}{rgb.shape}; expected uint8{self._shape}")
        self._make_room()
        number = self._pictures % SLOTS
        slot, numbers = np.frombuffer(self._slots.slot(number), np.uint8), np.ascontiguousarray(_even(rgb))
        if self._as_planes:
            planes(numbers, slot)
        else:
            slot[:] = numbers.reshape(-1)
        self._pictures += 1
        self._ask("picture", number)

    def sound(self, samples: Int16Array) -> None:
        """Add int16 samples, shape (n,)."""
        if len(samples):
            self._make_room()
            self._ask("sound", samples.astype("<i2", copy=False).tobytes())

    def finish(self) -> None:
        """Complete the file and end the worker."""
        self._ask("finish")
        while self._unanswered:
            self._collect()

    def _make_room(self) -> None:
        """Wait until fewer requests than slots are unanswered: then the next picture's slot is free."""
        while self._unanswered >= SLOTS:
            self._collect()

    def _ask(self, what: str, *arguments: object) -> None:
        with _lost():
            self._worker.send(_TASK, self._setup, what, *arguments, seconds=self._patience)
        self._unanswered += 1

    def _collect(self) -> None:
        """Take the next answer; raise the fault that it is."""
        with _lost():
            fault = self._worker.answer(self._patience)
        self._unanswered -= 1
        if fault is not None:
            raise _error(*fault)

    def __enter__(self) -> VideoEncoder:
        try:
            self._ask("open")
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self.finish()
        finally:
            self._stop()

    def _stop(self) -> None:
        self._worker.close()
        self._slots.close()


@contextmanager
def _lost() -> Iterator[None]:
    try:
        yield
    except WorkerError as error:
        raise LostEncoderError(f"the video encoder {error}") from None


def _error(text: str, number: int | None) -> Exception:
    """Return the error of a fault that the worker met."""
    if number is not None and number in errno.errorcode:
        return OSError(number, os.strerror(number))
    return OutputError(f"the video encoder failed: {text}")


def _even(rgb: ByteArray) -> ByteArray:
    """Repeat the last row and column of an odd picture: most formats have even sides only."""
    height, width = rgb.shape[:2]
    if height % 2 == 0 and width % 2 == 0:
        return rgb
    return np.pad(rgb, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
