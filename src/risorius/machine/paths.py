"""Look up paths that a user wrote; names that are too long or impossible count as missing files."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from ..errors import InputError


def path_of(name: object) -> Path:
    """Return the path that a user named; raise InputError if it cannot name a file."""
    if isinstance(name, str | PathLike):
        return Path(name)
    raise InputError(f"{type(name).__name__} does not name a file; expected a text or a path")


def is_file(path: Path) -> bool:
    """Whether there is a file of that name."""
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def exists(path: Path) -> bool:
    """Whether there is anything of that name."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


def is_utf8(name: str) -> bool:
    """Whether a name can be written down: Linux allows others, which Python reads as half characters."""
    try:
        name.encode()
    except UnicodeEncodeError:
        return False
    return True


def is_folder(path: Path) -> bool:
    """Whether there is a folder of that name."""
    try:
        return path.is_dir()
    except (OSError, ValueError):
        return False
