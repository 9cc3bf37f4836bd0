"""The folder of compiled kernels: one in the user's cache for each state of the kernels' sources.

numba itself looks only at the file of a kernel, so it would not notice a change in a function that it calls.
"""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import os
import shutil
import tempfile
from functools import lru_cache
from pathlib import Path

# Colours in messages that nobody reads cost a twentieth of compiling; numba looks when it is imported.
os.environ.setdefault("NUMBA_DISABLE_ERROR_MESSAGE_HIGHLIGHTING", "1")

import numba

from ...errors import warn

_VARIABLE = "NUMBA_CACHE_DIR"
_COMPILED = ("core/kernels", "face", "looks", "render")


def use_own_folder() -> None:
    """Let numba store its files in our folder, or in the one that NUMBA_CACHE_DIR names.

    If it cannot be written, kernels are stored in a temporary folder, for this process and those that it
    starts; a warning says so (RisoriusWarning). What the other folder holds is used nevertheless.
    """
    wanted = _wanted()
    if wanted is None or not _is_writable(wanted):
        wanted = _temporary(wanted)
        os.environ[_VARIABLE] = str(wanted)
    numba.config.CACHE_DIR = str(wanted)


def in_use() -> Path:
    """Return the folder of the kernels: ours, unless NUMBA_CACHE_DIR names another."""
    if _wanted() is None:
        use_own_folder()
    return _wanted() or Path(os.environ[_VARIABLE])


def _wanted() -> Path | None:
    named = os.environ.get(_VARIABLE)
    return Path(named) if named else folder()


def folder() -> Path | None:
    """Return the folder for the present sources: under XDG_CACHE_HOME, by default ~/.cache.

    None if neither is set and the user has no home, as in some containers.
    """
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        return Path(base).expanduser() / "risorius" / f"kernels-{sources()}"
    except RuntimeError:
        return None


def _is_writable(wanted: Path) -> bool:
    """Whether files can be made in a folder, which is made if it is missing; only trying tells."""
    try:
        wanted.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=wanted).close()
    except OSError:
        return False
    return True


def _temporary(wanted: Path | None) -> Path:
    """Return a folder that only this user reads and that is deleted at exit, with what `wanted` holds."""
    made = Path(tempfile.mkdtemp(prefix="risorius-kernels-"))
    atexit.register(shutil.rmtree, made, ignore_errors=True)
    if wanted is not None:
        with contextlib.suppress(OSError, shutil.Error):
            shutil.copytree(wanted, made, dirs_exist_ok=True)
    place = "there is no folder for a cache" if wanted is None else f"the cache '{wanted}' cannot be written"
    warn(f"{place}: each start compiles for itself; set {_VARIABLE} to a folder that can be written")
    return made


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
