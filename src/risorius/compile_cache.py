"""Where compiled kernels are kept: a folder of the user's, one for each state of their sources.

numba looks only at the file of the kernel itself, so that a change in what it calls would go unnoticed.
"""

from __future__ import annotations

import hashlib
import os
from pathlib import Path

import numba

_COMPILED = ("face", "render")


def use_own_folder() -> None:
    """Let numba keep its files in our folder, unless NUMBA_CACHE_DIR says where."""
    if "NUMBA_CACHE_DIR" not in os.environ:
        numba.config.CACHE_DIR = str(folder())


def folder() -> Path:
    """Return the folder for the present sources: under XDG_CACHE_HOME, by default ~/.cache."""
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser() / "risorius" / f"kernels-{source_digest()}"


def source_digest() -> str:
    """Return 16 hexadecimal digits that change with any source of a kernel."""
    root = Path(__file__).parent
    digest = hashlib.sha256()
    for package in _COMPILED:
        for path in sorted((root / package).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
