"""Memory that the program and the video worker share: a few slots, each of one picture.

The memory is a file that both map. The worker deletes it as soon as it has mapped it, so that none is left
behind even if both are killed.
"""

from __future__ import annotations

import mmap
import os
import tempfile
from contextlib import suppress
from pathlib import Path

IN_MEMORY = "/dev/shm"
"""The file's folder if there is room in it, else the system's folder of temporary files."""


class Slots:
    """`count` slots of `size` bytes each; `path` is where another process can find them."""

    def __init__(self, count: int, size: int) -> None:
        """Make the slots; raises OSError if there is no room for them."""
        self.path, descriptor = _reserve(count * size)
        try:
            self._memory = mmap.mmap(descriptor, count * size)
        finally:
            os.close(descriptor)
        self._size = size

    def slot(self, number: int) -> memoryview:
        """Return the bytes of a slot."""
        return memoryview(self._memory)[number * self._size : (number + 1) * self._size]

    def close(self) -> None:
        """Delete the file if it is still there. The memory goes with its last user."""
        self.path.unlink(missing_ok=True)


def map_slots(path: str) -> mmap.mmap:
    """Return the memory of the slots at `path`, all in a row, and delete the file."""
    with Path(path).open("rb") as file:
        memory = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    with suppress(OSError):  # Windows keeps a file that is mapped; the program deletes it
        Path(path).unlink()
    return memory


def _reserve(size: int) -> tuple[Path, int]:
    """Return a new file of `size` bytes that are sure to be there, and its descriptor."""
    with suppress(OSError):
        return _reserve_in(IN_MEMORY, size)
    return _reserve_in(tempfile.gettempdir(), size)


def _reserve_in(folder: str, size: int) -> tuple[Path, int]:
    descriptor, path = tempfile.mkstemp(prefix="risorius-pictures-", dir=folder)
    try:
        # A file with holes would end the process when it writes to a full disk.
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(descriptor, 0, size)
        else:
            os.write(descriptor, bytes(size))
    except OSError:
        os.close(descriptor)
        Path(path).unlink()
        raise
    return Path(path), descriptor
