"""A studio's server in a thread beside the tests."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import anyio
import anyio._backends._asyncio  # anyio imports it in the server's thread else
import uvicorn

import risorius
from risorius.live.serve.listening import bound
from risorius.studio.app import Studio
from risorius.studio.server import configured


@cache
def parse_ahead() -> None:
    """Solve one face, with the skin in motion, and import all of anyio.

    What is imported of anyio is parsed by pytest, since it is a plugin of it, too; if two threads parse at a
    time (pytest does as well, to show a failure), Python 3.11 confuses them: "AST constructor recursion depth
    mismatch".
    """
    next(iter(risorius.pose({}).faces()))
    for name in dir(anyio):
        getattr(anyio, name)


@contextmanager
def running(folder: Path) -> Iterator[tuple[Studio, int]]:
    """Run a studio and yield it with its port."""
    parse_ahead()
    listening, studio = bound(0), Studio(folder)
    config = configured(studio)
    # Pings carry random numbers, and hypothesis, at work in the tests' thread, would take them for its own.
    config.ws_ping_interval = None
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listening]}, daemon=True)
    thread.start()
    while not server.started:
        assert thread.is_alive()
        thread.join(0.01)
    try:
        yield studio, listening.getsockname()[1]
    finally:
        server.should_exit = True
        thread.join(20)
        listening.close()
