"""The folder of compiled kernels: one in the user's cache for each state of the kernels' sources.

numba itself looks only at the file of a kernel, so it would not notice a change in a function that it calls.
"""

from __future__ import annotations

import hashlib
import os
from functools import lru_cache
from pathlib import Path

import numba

_COMPILED = ("core/kernels", "face", "looks", "render")


def use_own_folder() -> None:
    """Let numba store its files in our folder, unless NUMBA_CACHE_DIR names another."""
    if "NUMBA_CACHE_DIR" not in os.environ:
        numba.config.CACHE_DIR = str(folder())


def in_use() -> Path:
    """Return the folder of the kernels: ours, unless NUMBA_CACHE_DIR names another."""
    return Path(os.environ.get("NUMBA_CACHE_DIR") or folder())


def folder() -> Path:
    """Return the folder for the present sources: under XDG_CACHE_HOME, by default ~/.cache."""
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser() / "risorius" / f"kernels-{sources()}"


def source_digest() -> str:
    """Return 16 hexadecimal digits that change with any source of a kernel."""
    root = Path(__file__).parents[2]
    digest = hashlib.sha256()
    for package in _COMPILED:
        for path in sorted((root / package).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


sources = lru_cache(maxsize=1)(source_digest)
"""`source_digest` of the sources that this process runs, read once."""
