"""Recorded sound: any file that libsndfile reads, or the sound of a film, as 16-bit mono on disk, checked on
the way.

WAV, FLAC, OGG, MP3, M4A, MP4 and WebM among them. Read block by block: memory does not grow with the length.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import numpy as np

from ...core.arrays import BoolArray, Float32Array
from ...core.speech.audio import Audio, AudioWriter
from ...errors import InputError, Place, SpeechWarning, warn
from .film_sound import FilmSound, container_of
from .joined_files import (
    CONTAINERS,
    ReachedFile,
    check_one_wav,
    check_rest,
    is_whole_ogg,
    may_be_joined,
    rest_after,
)
from .mixdown import Mixdown
from .wav_header import PatchedFile, with_known_length

EXPECTED = "WAV, FLAC, OGG, MP3, M4A, MP4, MOV or WebM"
LOWEST_RATE, HIGHEST_RATE = 8_000, 96_000
# Seconds.
SHORTEST, LONGEST = 0.1, 6 * 3600.0
# The loudest sample of a recording in which something can be heard: -60 dB of full scale.
SILENT_PEAK = 1e-3
# Sound is clipped if CLIPPED_RUN samples in a row hold the largest value, near full scale.
CLIPPED_LEVEL, CLIPPED_RUN = 0.985, 4
# Fewer clipped samples than this share are not worth a word.
CLIPPED_SHARE = 2e-4
_BLOCK = 65_536
_BEGINNING = 16  # bytes by which a film is told from a sound
_FULL_SCALE = 32_767


def read_recording(path: str | PathLike[str]) -> Audio:
    """Return a recording as 16-bit mono at its own sample rate.

    Several channels are averaged; if they cancel each other out, the loudest is taken.

    Raises InputError for a file that is missing or cannot be decoded, that is silent, shorter than 0.1 s or
    longer than 6 h, or sampled at less than 8 or more than 96 kHz. Warns (SpeechWarning) of clipped sound,
    and of samples that are not numbers, which become silence.
    """
    place = Place(str(path))
    with _hushed(), _opened(Path(path), place) as source:
        checks = _Checks(source.sample_rate)
        with AudioWriter(source.sample_rate) as writer:
            for block in _bounded(source, place):
                mono = checks.mended(block, writer.frames)
                writer.append(np.round(np.clip(mono, -1.0, 1.0) * _FULL_SCALE).astype(np.int16))
            audio = writer.finish()
    if audio.duration < SHORTEST:
        raise InputError(f"lasts {audio.duration:.3f} s; expected at least {SHORTEST:g} s of speech", place)
    checks.report(audio, place)
    return audio


@contextmanager
def _hushed() -> Iterator[None]:
    """Keep libraries from writing on standard error: libmpg123 complains there of damaged files."""
    try:
        stderr = os.dup(2)
    except OSError:
        yield  # it is closed
        return
    try:
        with Path(os.devnull).open("wb") as nowhere:
            os.dup2(nowhere.fileno(), 2)
        yield
    finally:
        os.dup2(stderr, 2)
        os.close(stderr)


def _opened(path: Path, place: Place) -> SoundFileSource | FilmSound:
    try:
        if not path.exists():
            raise InputError("there is no such file; expected a recording", place)
        if path.is_dir():
            raise InputError("is a folder; expected a recording", place)
        if not path.is_file():  # a pipe cannot be read twice, a device never ends
            raise InputError("is not a regular file; expected a recording that is saved in a file", place)
        with path.open("rb") as file:
            container = container_of(file.read(_BEGINNING))
    except (OSError, ValueError) as error:
        raise InputError(f"{_reason(error)}; expected a recording", place) from None
    source = SoundFileSource(path, place) if container is None else FilmSound(path, container, place)
    if not LOWEST_RATE <= source.sample_rate <= HIGHEST_RATE:
        source.close()
        expected = f"expected {LOWEST_RATE:,} to {HIGHEST_RATE:,}"
        raise InputError(f"has {source.sample_rate:,} samples per second; {expected}", place)
    return source


class SoundFileSource:
    """A file that libsndfile reads, its channels made one; InputError with its place if it cannot."""

    def __init__(self, path: Path, place: Place) -> None:
        import soundfile

        self._path, self._place = path, place
        self._read: PatchedFile | ReachedFile | None = None
        check_one_wav(path, place)
        try:
            self._read = _read_by_hand(path)
            source = self._read.source if isinstance(self._read, ReachedFile) else self._read or path
            self._file = soundfile.SoundFile(source, closefd=False)
        except (soundfile.LibsndfileError, OSError, ValueError) as error:
            if self._read is not None:
                self._read.close()
            raise InputError(_not_a_recording(path, error), place) from None
        self.sample_rate: int = self._file.samplerate
        self._container = CONTAINERS.get(self._file.format, "")

    def blocks(self) -> Iterator[Float32Array]:
        """Yield the samples, each block of shape (n,), in order."""
        import soundfile

        frames, mixdown = 0, Mixdown()
        try:
            for block in self._file.blocks(_BLOCK, dtype="float32", always_2d=True):
                frames += len(block)
                if isinstance(self._read, ReachedFile):
                    self._read.mark()
                with np.errstate(invalid="ignore", over="ignore"):  # `_Checks` mends what is not a number
                    yield mixdown.mono(block)
        except (soundfile.LibsndfileError, RuntimeError, ValueError) as error:
            at = frames / self.sample_rate
            fault = InputError(f"cannot be decoded from {at:.2f} s on: {_reason(error)}", self._place)
            if self._container != "ogg" or not is_whole_ogg(self._path):
                raise fault from None
            # At a joint of Ogg streams it gives up, although they are whole.
            yield from self._after_joint(frames, fault)
        else:
            if isinstance(self._read, ReachedFile) and self._read.has_more(self._container):
                yield from self._after_joint(frames)

    def _after_joint(self, frames: int, fault: InputError | None = None) -> Iterator[Float32Array]:
        """Yield the sound that is left of the file after `frames` samples.

        If there is none, raises `fault`, or InputError if much of the file is left.
        """
        assert isinstance(self._read, ReachedFile)
        reached, is_more = self._read.reached, False
        if self._container:
            for block in rest_after(
                self._path, self._container, self.sample_rate, frames, reached, self._place
            ):
                is_more = True
                yield block
        if not is_more and fault is not None:
            raise fault
        if not is_more:
            check_rest(self._path, reached, frames / self.sample_rate, self._place)

    def close(self) -> None:
        """Close the file."""
        self._file.close()
        if self._read is not None:
            self._read.close()

    def __enter__(self) -> SoundFileSource:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _read_by_hand(path: Path) -> PatchedFile | ReachedFile | None:
    """Return a file that libsndfile does not read alone as it should; None for any other."""
    with path.open("rb") as file:
        beginning = file.read(_BEGINNING)
    return ReachedFile(path) if may_be_joined(beginning) else with_known_length(path)


def _bounded(source: SoundFileSource | FilmSound, place: Place) -> Iterator[Float32Array]:
    """Yield a recording's sound in blocks; raise InputError if it is too long."""
    frames = 0
    for block in source.blocks():
        frames += len(block)
        if frames > LONGEST * source.sample_rate:
            raise InputError(f"is longer than {LONGEST / 3600:g} hours; expected less", place)
        yield block


def _not_a_recording(path: Path, error: Exception) -> str:
    """Return what a file is that cannot be read as a recording, or why it cannot."""
    from ...script.kinds import RECORDING, kind_of_file

    kind = kind_of_file(path)
    if kind is None or kind == RECORDING:
        return f"{_reason(error)}; expected {EXPECTED}"
    return f"is not a recording: it {kind}"


def _reason(error: Exception) -> str:
    text = str(getattr(error, "error_string", None) or getattr(error, "strerror", None) or error)
    if "possibly a pipe" in text:  # libsndfile's words for a file that is only named .mp3
        text = "Format not recognised"
    return f"cannot be read ({text.rstrip('.')})"


@dataclass
class _Checks:
    """Checks of the blocks of a recording as they are read; counts and positions are in samples."""

    sample_rate: int
    peak: float = 0.0
    clipped: int = 0
    clipped_from: int = -1
    odd: int = 0
    odd_from: int = -1

    def mended(self, block: Float32Array, offset: int) -> Float32Array:
        """Return the block that starts at sample `offset`, with zeros for samples that are not numbers."""
        not_finite = ~np.isfinite(block)
        if not_finite.any():
            self.odd_from = offset + int(np.argmax(not_finite)) if self.odd_from < 0 else self.odd_from
            self.odd += int(not_finite.sum())
            block = np.where(not_finite, np.float32(0.0), block)
        if block.size:
            self.peak = max(self.peak, float(np.abs(block).max()))
            self._count_clipped(np.abs(block) >= CLIPPED_LEVEL, offset)
        return block

    def _count_clipped(self, full: BoolArray, offset: int) -> None:
        edges = np.flatnonzero(np.diff(np.concatenate(([False], full, [False]))))
        runs = edges.reshape(-1, 2)
        long = runs[runs[:, 1] - runs[:, 0] >= CLIPPED_RUN]
        if len(long):
            self.clipped_from = offset + int(long[0, 0]) if self.clipped_from < 0 else self.clipped_from
            self.clipped += int((long[:, 1] - long[:, 0]).sum())

    def report(self, audio: Audio, place: Place) -> None:
        """Raise InputError for silence; warn of faults that were mended or cannot be."""
        if self.peak < SILENT_PEAK:
            raise InputError("is silent; expected speech", place)
        if self.odd:
            at = self.odd_from / self.sample_rate
            what = (
                "1 sample is not a number,"
                if self.odd == 1
                else f"{self.odd:,} samples are not numbers, the first"
            )
            _warn(place, f"{what} at {at:.3f} s; taken as silence")
        if self.clipped > CLIPPED_SHARE * audio.frames:
            share, at = 100.0 * self.clipped / audio.frames, self.clipped_from / self.sample_rate
            _warn(
                place, f"the sound is clipped ({share:.2g} %, first at {at:.3f} s); times will be less exact"
            )


def _warn(place: Place, message: str) -> None:
    warn(f"{place}: {message}", SpeechWarning)
