"""Files here and elsewhere: a name with a protocol (`s3://`, `memory://`) is read and written by fsspec."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

from ..errors import InputError, OutputError, Place, RisoriusError

_PROTOCOL = re.compile(r"\A[a-zA-Z][a-zA-Z0-9+.-]*+://")


def is_remote(name: str) -> bool:
    """Whether a name has a protocol."""
    return _PROTOCOL.match(name) is not None


def local_path(name: str) -> Path:
    """Return a name as a path, without its protocol."""
    return Path(_PROTOCOL.sub("", name))


def size_of(name: str) -> int | None:
    """Return how many bytes a file has, None if it is not there."""
    if is_remote(name):
        system, path = _opened(name)
        try:
            return int(system.size(path))
        except OSError:
            return None
    try:
        return Path(name).stat().st_size
    except (OSError, ValueError):
        return None


def state_of(name: str) -> tuple[int, str] | None:
    """Return a file's size and time of change, by which it is known to be the same; None if it is gone."""
    if is_remote(name):
        system, path = _opened(name)
        try:
            about = system.info(path)
        except OSError:
            return None
        changed = next(
            (about[key] for key in ("ETag", "mtime", "LastModified", "created") if key in about), ""
        )
        return int(about["size"]), str(changed)
    try:
        state = Path(name).stat()
    except (OSError, ValueError):
        return None
    return state.st_size, str(state.st_mtime_ns)


def read_bytes(name: str) -> bytes:
    """Return a file's bytes; raises InputError if it cannot be read."""
    try:
        if is_remote(name):
            system, path = _opened(name)
            return bytes(system.cat_file(path))
        return Path(name).read_bytes()
    except FileNotFoundError:
        raise InputError("there is no such file", Place(name)) from None
    except (OSError, ValueError) as error:
        raise InputError(f"cannot be read: {_reason(error)}", Place(name)) from None


def upload(file: Path, name: str) -> None:
    """Copy a file to a name with a protocol, where it appears whole or not at all; raises OutputError."""
    system, path = _opened(name, OutputError)
    try:
        system.makedirs(system._parent(path), exist_ok=True)
        # Written at once: object stores put it in place whole, and so does the file system in memory.
        system.pipe_file(path, file.read_bytes())
    except (OSError, ValueError) as error:
        raise OutputError(f"cannot be written: {_reason(error)}", Place(name)) from None


def make_folder(name: str) -> None:
    """Make the folder that a local file is written to, with those above it; raises OutputError."""
    if is_remote(name):
        return
    try:
        Path(name).parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        from ..machine.atomic import os_failure

        raise os_failure(Path(name).parent, error) from None


def _opened(name: str, kind: type[RisoriusError] = InputError) -> tuple[Any, str]:
    """Return the file system of a name, and the path in it."""
    try:
        import fsspec
    except ImportError:
        message = "needs fsspec; run pip install fsspec"
        raise kind(message, Place(name)) from None
    try:
        system, path = fsspec.core.url_to_fs(name)
    except (ImportError, ValueError) as error:
        raise kind(_reason(error), Place(name)) from None
    return system, path


def _reason(error: Exception) -> str:
    if isinstance(error, OSError) and error.errno is not None and error.strerror:
        return os.strerror(error.errno)
    return " ".join(str(error).split())[:200] or type(error).__name__
