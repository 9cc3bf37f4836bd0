"""Files appear whole or not at all: written beside their place, then renamed."""

from __future__ import annotations

import errno
import os
import secrets
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from functools import cache
from pathlib import Path

from ..errors import DiskFullError, OutputError, Place

_BEGINNING, _TEMPORARY = ".risorius-", ".part"
_run: ContextVar[str] = ContextVar("run that creates temporary files", default="")
_OLD = 86_400.0  # s after which the file of a process that was killed is removed
_FULL = {errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)}


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield an empty temporary file in the folder of `path`, renamed to `path` when the block ends well.

    On any exception the temporary file is removed and an existing `path` stays as it was. A link is
    followed: the file that it points to is replaced. Raises OutputError in place of any OSError.
    """
    try:
        # Renaming onto a link would replace the link itself.
        final = Path(os.path.realpath(path))
        _sweep(final.parent)
        temporary = _name_beside(final)
        try:  # from before there is a file: an interrupt may come at any moment
            _create(temporary)
            yield temporary
            temporary.replace(final)
        except BaseException:
            temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise os_failure(path, error) from error


def os_failure(path: Path, error: OSError) -> OutputError:
    """Return the system's message as one line about `path`."""
    if error.errno in _FULL:
        return DiskFullError("no space left on the disk; nothing was written", Place(str(path)))
    message = f"cannot be written: {error.strerror or error}"
    other = None if error.filename is None else Path(os.fsdecode(error.filename))
    if other is not None and other.suffix != _TEMPORARY and other != path:
        message += f" ({other})"
    return OutputError(message, Place(str(path)))


@contextmanager
def temporaries_of(run: str) -> Iterator[None]:
    """Put the name of a `run` into those of the temporary files that are created within the block."""
    token = _run.set(run)
    try:
        yield
    finally:
        _run.reset(token)


def remove_temporaries(folder: Path, run: str) -> None:
    """Remove the temporary files that a `run` left in a folder when it was killed."""
    for path in folder.glob(f"{_BEGINNING}{run}-*{_TEMPORARY}"):
        with suppress(OSError):
            path.unlink()


@cache
def _sweep(folder: Path) -> None:
    """Remove the files that killed processes left in a folder, once for each folder."""
    with suppress(OSError):
        for left in folder.glob(f"{_BEGINNING}*{_TEMPORARY}"):
            if time.time() - left.stat().st_mtime > _OLD:
                left.unlink(missing_ok=True)


def _name_beside(final: Path) -> Path:
    """Return a name in the folder of `final` that no other file has."""
    run = f"{_run.get()}-" if _run.get() else ""
    return final.with_name(f"{_BEGINNING}{run}{secrets.token_hex(8)}{_TEMPORARY}")


def _create(path: Path) -> None:
    """Create an empty file with the permissions that any new file gets."""
    os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
