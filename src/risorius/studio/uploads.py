"""Uploads of a page: read within bounds, to disk or to memory, whatever length they claim to have."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import suppress
from pathlib import Path

from starlette.requests import ClientDisconnect, Request

from ..errors import InputError

BEGINNING = "upload-"
"""Prefix of the names of unfinished files, which are taken in or removed as soon as they are whole."""
_OLD = 86_400.0  # s after which such a file is of a server that was killed


class UnfinishedUploadError(InputError):
    """The client went before all of an upload was here: nobody hears the answer."""


class TooLargeError(InputError):
    """An upload is larger than it may be."""


async def to_file(request: Request, folder: Path, most: int) -> Path:
    """Return a new file in `folder` with the request's body; raise TooLargeError beyond `most` bytes."""
    number, name = tempfile.mkstemp(prefix=BEGINNING, dir=folder)
    path, size = Path(name), 0
    try:
        with os.fdopen(number, "wb") as file:
            async for piece in _pieces(request):
                size += len(piece)
                _check(size, most)
                file.write(piece)
    except (InputError, OSError):
        path.unlink(missing_ok=True)
        raise
    return path


def sweep(folder: Path) -> None:
    """Remove the unfinished uploads of a killed server from all sessions in `folder`."""
    latest = time.time() - _OLD
    for path in folder.glob(f"*/{BEGINNING}*"):
        # Another server on the same folder may sweep, too.
        with suppress(OSError):
            if path.is_file() and path.stat().st_mtime < latest:
                path.unlink()


async def to_memory(request: Request, most: int) -> bytes:
    """Return the request's body; raise TooLargeError beyond `most` bytes."""
    data = bytearray()
    async for piece in _pieces(request):
        _check(len(data) + len(piece), most)
        data += piece
    return bytes(data)


async def _pieces(request: Request) -> AsyncIterator[bytes]:
    try:
        async for piece in request.stream():
            yield piece
    except ClientDisconnect:
        raise UnfinishedUploadError("the upload was broken off") from None


def _check(size: int, most: int) -> None:
    if size > most:
        raise TooLargeError(f"the upload is larger than {most:,} bytes")
