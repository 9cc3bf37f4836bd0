"""The folder for what takes long to make and is the same at every start: one in the user's cache."""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import json
import os
import shutil
import tempfile
from functools import lru_cache
from pathlib import Path

from ..errors import warn

VARIABLE = "RISORIUS_CACHE_DIR"
ROOT = Path(__file__).parents[1]
PACKAGED = ROOT / "machine" / "code"
"""The folder of the machine code that was made when the package was built."""
INDEX = "index.json"
"""The file there that an installed package has, and a tree of sources has not."""
_COMPUTING = ("core", "face", "looks", "machine", "render")


def in_use() -> Path:
    """Return the folder: `folder`, or if it cannot be written, a temporary one.

    The temporary folder is for this process and those that it starts; a warning says so (RisoriusWarning).
    What the other folder holds is used nevertheless.
    """
    return _tried(folder())


@lru_cache(maxsize=4)
def _tried(folder: Path | None) -> Path:
    if folder is not None and _is_writable(folder):
        return folder
    temporary = _temporary(folder)
    os.environ[VARIABLE] = str(temporary)
    return temporary


def folder() -> Path | None:
    """Return the folder that RISORIUS_CACHE_DIR names, by default one under XDG_CACHE_HOME or ~/.cache.

    None if no variable is set and the user has no home, as in some containers.
    """
    named = os.environ.get(VARIABLE)
    if named:
        return Path(named)
    base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    try:
        return Path(base).expanduser() / "risorius" / "computed"
    except RuntimeError:
        return None


def _is_writable(folder: Path) -> bool:
    """Whether files can be made in a folder, which is made if it is missing; only trying tells."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True


def _temporary(folder: Path | None) -> Path:
    """Return a folder that only this user reads and that is deleted at exit, with what `folder` holds."""
    temporary = Path(tempfile.mkdtemp(prefix="risorius-"))
    atexit.register(shutil.rmtree, temporary, ignore_errors=True)
    if folder is not None:
        with contextlib.suppress(OSError, shutil.Error):
            shutil.copytree(folder, temporary, dirs_exist_ok=True)
    place = "there is no folder for a cache" if folder is None else f"the cache '{folder}' cannot be written"
    warn(f"{place}: each start computes anew; set {VARIABLE} to a folder that can be written")
    return temporary


@lru_cache(maxsize=1)
def built() -> dict[str, dict[str, str]] | None:
    """Return what is known of a package that is installed, or None in a tree of sources, which may change.

    `sources` is the digest of its sources, `kernels` has that of each kernel.
    """
    try:
        digests: dict[str, dict[str, str]] = json.loads((PACKAGED / INDEX).read_bytes())
    except (OSError, ValueError):
        return None
    return digests


def source_digest() -> str:
    """Return 16 hexadecimal digits that change with any source of the face, the renderer and kernels."""
    digest = hashlib.sha256()
    for package in _COMPUTING:
        for path in sorted((ROOT / package).rglob("*.py")):
            digest.update(path.relative_to(ROOT).as_posix().encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]


@lru_cache(maxsize=1)
def sources() -> str:
    """Return `source_digest` of the sources that this process runs, found once."""
    digests = built()
    return digests["sources"]["all"] if digests else source_digest()
