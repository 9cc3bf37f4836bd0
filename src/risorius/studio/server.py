"""Running the studio: bound to this machine alone."""

from __future__ import annotations

import os
import threading
import webbrowser
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import uvicorn

from ..errors import OutputError, Place
from ..live.serve.listening import HOST, bound, server_config
from . import limits
from .app import Studio

PORT = 8765


def default_folder() -> Path:
    """Return where sessions are kept: RISORIUS_STUDIO, or a folder of the user's."""
    folder = os.environ.get("RISORIUS_STUDIO")
    if folder:
        return Path(folder)
    base = os.environ.get("XDG_DATA_HOME") or "~/.local/share"
    return Path(base).expanduser() / "risorius" / "studio"


def serve(
    port: int = PORT,
    *,
    folder: Path | None = None,
    browser: bool = True,
    say: Callable[[str], None] = print,
) -> None:
    """Serve the studio until interrupted; tell its address, and open a browser there if asked.

    Raises OutputError if the port is taken, or the folder cannot be made.
    """
    home = folder or default_folder()
    if home.exists() and not home.is_dir():
        raise OutputError("is not a folder; expected one for the sessions", Place(str(home)))
    try:
        home.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"cannot keep sessions: {error.strerror}", Place(str(home))) from None
    listening = bound(port)
    url = f"http://{HOST}:{listening.getsockname()[1]}/"
    server = uvicorn.Server(configured(Studio(home)))
    say(f"The studio is at {url} (Ctrl+C ends it)")
    if browser:
        threading.Timer(0.5, webbrowser.open, [url]).start()
    # Interrupted is how a server ends.
    with suppress(KeyboardInterrupt):
        server.run(sockets=[listening])


def configured(studio: Studio) -> uvicorn.Config:
    """Return how uvicorn runs a studio."""
    return server_config(studio.app(), limits.MESSAGE)
