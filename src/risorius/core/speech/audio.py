"""Sound on disk, so that memory does not grow with the clip's length."""

from __future__ import annotations

import shutil
import tempfile
import wave
import weakref
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np

from ..arrays import Int16Array

_BLOCK = 65_536  # samples
Samples = Int16Array
"""Sound: samples (n,) of one channel, full scale 32,767."""


@dataclass(frozen=True, slots=True)
class Audio:
    """Mono 16-bit sound in a WAV file. `frames` is the number of samples."""

    path: Path
    sample_rate: int
    frames: int
    # Keeps a temporary folder alive as long as the sound is in use.
    keeper: object = None

    def __repr__(self) -> str:
        """Return one line: how long it is, and where it stands."""
        return f"<Audio of {self.duration:.2f} s at {self.sample_rate} Hz, {str(self.path)!r}>"

    def __reduce__(self) -> tuple[Any, ...]:
        # Pickle the samples: the temporary file is deleted with this process and is not on other machines.
        return _written, (self.read(), self.sample_rate)

    @property
    def duration(self) -> float:
        """Seconds."""
        return self.frames / self.sample_rate

    def read(self, start: int = 0, count: int | None = None) -> Samples:
        """Return `count` samples from `start` on (fewer at the end), int16, shape (n,)."""
        with wave.open(str(self.path), "rb") as source:
            source.setpos(min(max(start, 0), self.frames))
            data = source.readframes(self.frames if count is None else count)
        return np.frombuffer(data, dtype="<i2").astype(np.int16, copy=False)

    def blocks(self, size: int = _BLOCK) -> Iterator[Samples]:
        """Yield the sound in blocks of at most `size` samples."""
        for start in range(0, self.frames, size):
            yield self.read(start, size)


class _Folder:
    """A temporary folder that is deleted with the last reference to it, or at exit."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="risorius-"))
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


class AudioWriter:
    """Writes sound to a temporary WAV file, which is deleted with the last reference to its Audio."""

    def __init__(self, sample_rate: int) -> None:
        self.sample_rate = sample_rate
        self.frames = 0
        self._folder = _Folder()
        self._path = self._folder.path / "voice.wav"
        self._file = wave.open(str(self._path), "wb")  # noqa: SIM115 - closed by finish() or __exit__
        self._file.setnchannels(1)
        self._file.setsampwidth(2)
        self._file.setframerate(sample_rate)

    def append(self, samples: Samples) -> None:
        """Add int16 samples, shape (n,)."""
        self._file.writeframes(np.ascontiguousarray(samples, dtype="<i2").tobytes())
        self.frames += len(samples)

    def silence(self, seconds: float) -> None:
        """Add silence, rounded to whole samples."""
        remaining = round(seconds * self.sample_rate)
        while remaining > 0:
            self.append(np.zeros(min(remaining, _BLOCK), np.int16))
            remaining -= _BLOCK

    def finish(self) -> Audio:
        """Close the file and return the sound."""
        self._file.close()
        return Audio(self._path, self.sample_rate, self.frames, self._folder)

    def __enter__(self) -> AudioWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()


def _written(samples: Samples, sample_rate: int) -> Audio:
    with AudioWriter(sample_rate) as writer:
        writer.append(samples)
        return writer.finish()


def silence(seconds: float, sample_rate: int = 22_050) -> Audio:
    """Return `seconds` of silence."""
    with AudioWriter(sample_rate) as writer:
        writer.silence(seconds)
        return writer.finish()
