"""A studio's server in a thread beside the tests."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path

import uvicorn

import risorius
from risorius.studio.app import Studio
from risorius.studio.server import bound, configured


@cache
def compile_faces() -> None:
    """Solve one face, with the skin in motion.

    To compile, numba parses a kernel's source; where pytest parses a module at the same time (to rewrite its
    asserts, or to show a failure), Python 3.11 confuses the two: "AST constructor recursion depth mismatch".
    """
    next(iter(risorius.pose({}).faces()))


@contextmanager
def running(folder: Path) -> Iterator[tuple[Studio, int]]:
    """Run a studio and yield it with its port."""
    compile_faces()
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
