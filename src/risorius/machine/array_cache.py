"""A cache on disk for arrays that take long to compute and are the same at every start."""

from __future__ import annotations

import contextlib
import hashlib
import os
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..core.arrays import AnyArray
from . import cache_folder
from .npz import read_arrays

MOST_FILES = (
    240  # a head at one age needs thirteen, and a picture of it one for its size and one for its view
)
_LARGEST = 2_000_000_000  # bytes
_TEMPORARY, _OLD = ".part", 86_400.0  # of a file that is written, and s after which nobody writes it any more


def cached_arrays(
    name: str, inputs: Sequence[npt.ArrayLike], compute: Callable[[], tuple[AnyArray, ...]]
) -> tuple[AnyArray, ...]:
    """Return the result of `compute`, from disk if it was computed before from the same `inputs`.

    `compute` must depend on `inputs` and the sources of the face and the renderer alone. A folder that cannot
    be read or written costs time, never the result. Arrays are in C order, as kernels are compiled for them.
    """
    path = _folder() / f"{name}-{_digest(inputs)}.npz"
    stored = _read(path)
    if stored is None:
        stored = tuple(np.asarray(array, order="C") for array in compute())
        with contextlib.suppress(OSError):
            _write(path, stored)
            _thin_out(path.parent)
    return stored


def _folder() -> Path:
    return cache_folder.in_use() / "arrays"


def _digest(inputs: Sequence[npt.ArrayLike]) -> str:
    digest = hashlib.blake2b(f"{cache_folder.sources()} {np.__version__}".encode(), digest_size=16)
    for array in map(np.ascontiguousarray, inputs):
        digest.update(f"{array.dtype} {array.shape} ".encode())
        digest.update(array.data)
    return digest.hexdigest()


def _read(path: Path) -> tuple[AnyArray, ...] | None:
    try:
        with path.open("rb") as whole:
            arrays = read_arrays(whole, _LARGEST)
        return tuple(arrays[f"arr_{k}"] for k in range(len(arrays)))
    except (OSError, ValueError, KeyError, MemoryError):
        return None


def _write(path: Path, arrays: tuple[AnyArray, ...]) -> None:
    """Write beside, then rename: another process may look for the same file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    number, beside = tempfile.mkstemp(suffix=_TEMPORARY, dir=path.parent)
    try:
        with os.fdopen(number, "wb") as file:
            np.savez(file, *arrays)
        Path(beside).replace(path)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise


def _thin_out(folder: Path) -> None:
    """Remove the oldest files beyond `MOST_FILES`, and those that killed processes left unfinished."""
    for left in folder.glob(f"*{_TEMPORARY}"):
        if time.time() - left.stat().st_mtime > _OLD:
            left.unlink(missing_ok=True)
    files = sorted(folder.glob("*.npz"), key=lambda path: path.stat().st_mtime)
    for path in files[: max(0, len(files) - MOST_FILES)]:
        path.unlink(missing_ok=True)
