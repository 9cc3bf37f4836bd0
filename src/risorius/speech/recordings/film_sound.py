"""The sound of films and of telephones' recordings: m4a, mp4, mov, webm, aac, by a worker process."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from ...core.arrays import Float32Array
from ...errors import InputError, Place
from ...machine.workers import Worker, WorkerError

PATIENCE = 60.0  # seconds without a sound after which the decoder is given up
_TASK = f"{Path(__file__).with_name('film_worker.py')}:read"
_BOXES = (b"ftyp", b"moov", b"mdat", b"wide", b"free", b"skip", b"pnot")
_MATROSKA = b"\x1a\x45\xdf\xa3"
_ADTS = (b"\xff\xf0", b"\xff\xf1", b"\xff\xf8", b"\xff\xf9")


def container_of(beginning: bytes) -> str | None:
    """Return the container that a file of these first bytes is, as the decoder names it; None for no film."""
    if beginning[4:8] in _BOXES:
        return "mov"
    if beginning.startswith(_MATROSKA):
        return "matroska"
    return "aac" if beginning.startswith(_ADTS) else None


class FilmSound:
    """The sound of a film, its channels averaged. Use as a context manager: leaving it ends the decoder.

    It begins with the picture: if the recorded sound begins later, silence comes first. `sample_rate` is
    known from the start; `rate`: the one wanted, 0 for the sound's own. `patient`: single packets that cannot
    be decoded are left out. Raises InputError with the file's place if it has no sound, if it cannot be
    decoded, or if the decoder does not answer for `PATIENCE` seconds.
    """

    def __init__(
        self, path: Path, container: str, place: Place, rate: int = 0, *, patient: bool = False
    ) -> None:
        self._place, self._decoded = place, 0
        try:
            self._worker = Worker()
            file = os.fspath(path.absolute())
            self._worker.send(_TASK, file, container, rate, patient, tells=True)
        except WorkerError as error:
            raise self._fault(f"the decoder {error}") from None
        self._items = self._worker.items(PATIENCE)
        try:
            self.sample_rate: int = self._next() or 0
        except BaseException:
            self.close()
            raise

    def blocks(self) -> Iterator[Float32Array]:
        """Yield the samples, each block of shape (n,), in order."""
        while data := self._next():
            if isinstance(data, float):
                yield from self._silence(data)
                continue
            self._decoded += len(data) // 4
            yield np.frombuffer(data, "<f4").astype(np.float32, copy=False)

    def _silence(self, seconds: float) -> Iterator[Float32Array]:
        """Yield silence in blocks of at most a second."""
        left = round(seconds * self.sample_rate)
        while left > 0:
            size = min(left, self.sample_rate)
            self._decoded, left = self._decoded + size, left - size
            yield np.zeros(size, np.float32)

    def _next(self) -> Any:
        """Return what the decoder tells next, None at the end."""
        try:
            return next(self._items)
        except StopIteration as end:
            fault = end.value
        except WorkerError as error:
            fault = f"the decoder {error}", False
        if fault is not None:
            raise self._fault(*fault)
        return None

    def _fault(self, reason: str, silent: bool = False) -> InputError:
        if silent:
            return InputError(f"{reason}; expected a recording, or a film with a voice", self._place)
        if not self._decoded:
            return InputError(f"cannot be read ({reason}); expected a recording", self._place)
        at = self._decoded / self.sample_rate
        return InputError(f"cannot be decoded from {at:.2f} s on: {reason}", self._place)

    def close(self) -> None:
        """End the decoder."""
        self._worker.close()

    def __enter__(self) -> FilmSound:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
