"""Sound files put end to end: libsndfile reads the first and says nothing of the others.

It stops where the first one's header says that it ends. So the bytes that it has not read tell of a joint;
the decoder of films reads on from there.
"""

from __future__ import annotations

import io
import mmap
import os
import struct
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...core.arrays import Float32Array
from ...errors import InputError, Place
from .film_sound import FilmSound
from .mixdown import Mixdown

CONTAINERS = {"MP3": "mp3", "MPEG": "mp3", "FLAC": "flac", "OGG": "ogg"}
"""libsndfile's formats that may be joined, as the decoder of films names them."""

_STARTS = (b"fLaC", b"OggS", b"ID3")
_APE_HEADER, _ID3V1 = 32, 128  # bytes
_FLAC_START = b"fLaC\0\0\0\x22"
_WAV_HEADER, _BYTES_A_SECOND = 44, 28  # bytes, and where in them the rate stands
_LOOKAHEAD = 65_536  # bytes: libsndfile reads a little more than it decodes
_OGG_HEADER = 27  # bytes
_BLOCK = 65_536  # samples
_LEAST = 0.05  # seconds of sound after a joint: less is what decoders differ in at the end of a file
_MUCH = 0.02  # share of the file that may be left without a reason


def may_be_joined(beginning: bytes) -> bool:
    """Tell whether a file of these first bytes is of a kind that is read on after a joint."""
    return beginning.startswith(_STARTS) or (beginning[:1] == b"\xff" and beginning[1:2] >= b"\xe0")


class ReachedFile(io.FileIO):
    """A file that libsndfile reads, and that knows how far it has been read."""

    def __init__(self, path: Path) -> None:
        super().__init__(path, "rb")
        self.reached = 0

    @property
    def source(self) -> int | ReachedFile:
        """The form in which libsndfile reads it fastest; on Windows it may not know our numbers of files."""
        return self.fileno() if os.name == "posix" else self

    def mark(self) -> None:
        """Note the place to which it has been read."""
        self.reached = max(self.reached, self.tell())

    def has_more(self, container: str) -> bool:
        """Tell whether something is left behind what was read that is not a tag."""
        self.seek(self.reached)
        if not is_tag(self.read(_LOOKAHEAD)):
            return True
        return container == "flac" and bool(flac_starts(Path(os.fsdecode(self.name)), self.reached))


class PartOfFile(io.FileIO):
    """A file from the byte `start` on, as if it were one of its own."""

    def __init__(self, path: Path, start: int) -> None:
        super().__init__(path, "rb")
        self._start = start
        self.seek(0)

    def seek(self, position: int, whence: int = io.SEEK_SET, /) -> int:
        """Go to a position, as of any file."""
        shift = self._start if whence == io.SEEK_SET else 0
        return super().seek(position + shift, whence) - self._start

    def tell(self) -> int:
        """Return the position."""
        return super().tell() - self._start


def is_tag(rest: bytes) -> bool:
    """Tell whether the end of a file is a tag of MP3, zeros, or nothing."""
    if rest.startswith(b"APETAGEX") and len(rest) >= _APE_HEADER:
        (size,) = struct.unpack_from("<I", rest, 12)
        rest = rest[_APE_HEADER + size :]
    if rest.startswith(b"TAG") and len(rest) >= _ID3V1:
        rest = rest[_ID3V1:]
    return not rest.strip(b"\0")


def flac_starts(path: Path, reached: int) -> list[int]:
    """Return where FLAC files begin behind the first one, which was read to about the byte `reached`."""
    with path.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        starts, at = [], data.find(_FLAC_START, max(reached - _LOOKAHEAD, 1))
        while at >= 0:
            starts.append(at)
            at = data.find(_FLAC_START, at + 1)
        return starts


def rest_after(
    path: Path, container: str, rate: int, frames: int, reached: int, place: Place
) -> Iterator[Float32Array]:
    """Yield the sound after the first `frames` samples at `rate`, in blocks, until the file ends.

    `reached`: the bytes that hold them, and perhaps a few more. Raises InputError if it cannot be decoded.
    """
    starts = flac_starts(path, reached) if container == "flac" else []
    if starts:
        for start in starts:
            yield from _part(path, start, rate, place)
        return
    skipped, waiting, least = frames, np.zeros(0, np.float32), round(_LEAST * rate)
    with FilmSound(path, container, place, rate, patient=True) as sound:
        for block in sound.blocks():
            if skipped:
                cut = min(skipped, len(block))
                skipped, block = skipped - cut, block[cut:]
            waiting = np.concatenate([waiting, block])
            if len(waiting) >= least:
                yield waiting
                waiting, least = waiting[:0], 1


def _part(path: Path, start: int, rate: int, place: Place) -> Iterator[Float32Array]:
    """Yield the sound of the file that begins at a byte: libav loses a frame at the joint of FLAC files."""
    import soundfile

    mixdown = Mixdown()
    try:
        with PartOfFile(path, start) as file, soundfile.SoundFile(file) as part:
            if part.samplerate != rate:
                found = f"{part.samplerate:,} samples per second, the one before {rate:,}"
                raise InputError(
                    f"the file that follows at byte {start:,} has {found}; expected one file", place
                )
            for block in part.blocks(_BLOCK, dtype="float32", always_2d=True):
                yield mixdown.mono(block)
    except (soundfile.LibsndfileError, RuntimeError, ValueError) as error:
        message = f"the file that follows at byte {start:,} cannot be decoded; expected one file"
        raise InputError(message, place) from error


def is_whole_ogg(path: Path) -> bool:
    """Tell whether an Ogg file consists of pages, one after the other, to its end (RFC 3533, section 6)."""
    with path.open("rb") as file:
        while header := file.read(_OGG_HEADER):
            if len(header) < _OGG_HEADER or not header.startswith(b"OggS"):
                return is_tag(header)
            file.seek(sum(file.read(header[-1])), io.SEEK_CUR)
    return True


def check_rest(path: Path, reached: int, seconds: float, place: Place) -> None:
    """Raise InputError if much of a file is left behind a sound of some seconds, and is not a tag."""
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(reached)
        rest = file.read(_LOOKAHEAD)
    if (size - reached) / size > _MUCH and not is_tag(rest):
        raise _joined(seconds, (size - reached) / size, place)


def check_one_wav(path: Path, place: Place) -> None:
    """Raise InputError if another WAV file follows the one that a file begins with."""
    with path.open("rb") as file:
        header = file.read(_WAV_HEADER)
        if header[:4] != b"RIFF" or header[8:16] != b"WAVEfmt ":
            return
        end = 8 + int.from_bytes(header[4:8], "little")
        file.seek(end + end % 2)
        if file.read(4) == b"RIFF":
            (bytes_a_second,) = struct.unpack_from("<I", header, _BYTES_A_SECOND)
            seconds = (end - _WAV_HEADER) / max(bytes_a_second, 1)
            raise _joined(seconds, 1.0 - end / path.stat().st_size, place)


def _joined(seconds: float, left: float, place: Place) -> InputError:
    message = f"the sound ends at {seconds:.2f} s, but {left:.0%} of the file is left"
    return InputError(f"{message}; expected one recording, not several files end to end", place)
