"""WAV files whose header has no length of the sound, as those written to a pipe: it ends with the file."""

from __future__ import annotations

import io
import struct
from collections.abc import Iterator
from pathlib import Path

_RIFF_HEADER, _CHUNK_HEADER = 12, 8
_MOST_CHUNKS = 1000
_LARGEST = 0xFFFF_FFF0


class PatchedFile(io.FileIO):
    """A file that is read as if four bytes at `at` were `data`."""

    def __init__(self, path: Path, at: int, data: bytes) -> None:
        super().__init__(path, "rb")
        self._at, self._data = at, data

    def read(self, size: int | None = -1, /) -> bytes:
        """Return the next bytes."""
        start = self.tell()
        found = bytearray(super().read(-1 if size is None else size))
        for index, byte in enumerate(self._data, self._at - start):
            if 0 <= index < len(found):
                found[index] = byte
        return bytes(found)

    def readinto(self, buffer: bytearray | memoryview, /) -> int:  # type: ignore[override]
        """Fill a buffer with the next bytes; return how many there are."""
        view = memoryview(buffer).cast("B")
        found = self.read(len(view))
        view[: len(found)] = found
        return len(found)


def with_known_length(path: Path) -> PatchedFile | None:
    """Return a WAV file whose data have the size 0 as if they went on to its end; None for any other file."""
    size = path.stat().st_size
    with path.open("rb") as file:
        for at, name, length in _chunks(file):
            if name == b"data":
                rest = size - at - _CHUNK_HEADER
                if length or not rest:
                    return None
                return PatchedFile(path, at + 4, struct.pack("<I", min(rest, _LARGEST)))
    return None


def _chunks(file: io.BufferedReader) -> Iterator[tuple[int, bytes, int]]:
    """Yield where the chunks of a RIFF file begin, their names and sizes; none of another file."""
    header = file.read(_RIFF_HEADER)
    if header[:4] != b"RIFF" or header[8:] != b"WAVE":
        return
    at = _RIFF_HEADER
    for _ in range(_MOST_CHUNKS):
        file.seek(at)
        chunk = file.read(_CHUNK_HEADER)
        if len(chunk) < _CHUNK_HEADER:
            return
        name, length = struct.unpack("<4sI", chunk)
        yield at, name, length
        at += _CHUNK_HEADER + length + length % 2
