"""`risorius studio`."""

from __future__ import annotations

import atexit
import os
import sys
from pathlib import Path

import click

from .console import Console
from .options import Command, NumberIn, option


@click.command(cls=Command, short_help="See, hear and shape a performance in the browser.")
@option(
    "--port",
    group="Server",
    type=NumberIn(0, 65535),
    metavar="N",
    help="Port; 0 chooses a free one.  [default: 8765]",
)
@option("--no-browser", group="Server", is_flag=True, help="Do not open a browser.")
@option(
    "--folder",
    group="Server",
    type=click.Path(path_type=Path),
    help="Folder of the sessions.  [default: the user's data]",
)
def studio(port: int | None, no_browser: bool, folder: Path | None) -> None:
    """See, hear and shape a performance in the browser, on this machine alone."""
    from ..studio.server import PORT, serve

    serve(PORT if port is None else port, folder=folder, browser=not no_browser, say=Console().say)
    leave()


def leave() -> None:
    """End the process at once, with exit code 0, after the functions registered for its end.

    Threads may be at work in a compiler written in C++: as they stood when a process ended the usual way,
    which destroys what they work with, they would abort it.
    """
    atexit._run_exitfuncs()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)
