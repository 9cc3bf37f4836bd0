"""Archives of arrays (.npz), checked before they are unpacked: they may come from anywhere."""

from __future__ import annotations

import math
import threading
import zipfile
from pathlib import Path
from typing import IO

import numpy as np

from ..core.arrays import AnyArray

LARGEST = 64_000_000
"""Bytes of the arrays of an archive: a head has less than one million."""
_MEMBERS = 10_000
_one_at_a_time = threading.Lock()


def read_arrays(file: Path | IO[bytes], largest: int = LARGEST) -> dict[str, AnyArray]:
    """Return all arrays by name; raise OSError for a file that cannot be read.

    Raises ValueError for one that is not such an archive, is damaged or encrypted, holds objects, or whose
    arrays have more than `largest` bytes, which is known before any of them is unpacked.

    Only one thread reads at a time: numpy parses an array's header as Python source, and Python 3.11 confuses
    syntax trees that two threads parse at once ("AST constructor recursion depth mismatch").
    """
    if isinstance(file, Path):
        with file.open("rb") as opened:
            return read_arrays(opened, largest)
    try:
        with _one_at_a_time, zipfile.ZipFile(file) as archive:
            members = archive.infolist()
            _check_sizes(members, largest)
            return {member.filename.removesuffix(".npy"): _array(archive, member) for member in members}
    except ValueError:
        raise
    except Exception as error:
        # zipfile, zlib and numpy's parser of headers raise a dozen kinds, OSError among them.
        raise ValueError(f"is damaged ({error or type(error).__name__})") from error


def _check_sizes(members: list[zipfile.ZipInfo], largest: int) -> None:
    if len(members) > _MEMBERS:
        raise ValueError(f"holds {len(members):,} arrays; expected at most {_MEMBERS:,}")
    size = sum(member.file_size for member in members)
    if size > largest:
        raise ValueError(f"holds {size // 1_000_000:,} MB; expected at most {largest // 1_000_000} MB")


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> AnyArray:
    with archive.open(member) as file:
        shape, dtype, start = _header(file)
        # A header may promise petabytes, which numpy would make room for.
        if start + math.prod(shape) * dtype.itemsize != member.file_size:
            raise ValueError(f"'{member.filename}' does not hold as many numbers as its header says")
    with archive.open(member) as file:
        return np.asarray(np.lib.format.read_array(file, allow_pickle=False))


def _header(file: IO[bytes]) -> tuple[tuple[int, ...], np.dtype, int]:
    """Return an array's shape and type, and where its numbers begin."""
    version = np.lib.format.read_magic(file)
    read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    shape, _, dtype = read(file)
    if dtype.hasobject or any(size < 0 for size in shape):
        raise ValueError("an array holds objects; expected numbers")
    return shape, dtype, file.tell()
