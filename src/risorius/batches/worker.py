"""A warm process that performs one line after the other: the program that `pool` starts."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

READY = "ready"


def serve(descriptor: int, task: str) -> None:
    """Answer requests that come through a socket by `task`, until its other end is closed."""
    # Whoever interrupts the run interrupts its own process; that ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    perform = _task(task)
    with Connection(descriptor) as connection:
        try:
            connection.send(READY)
            while True:
                connection.send(perform(*connection.recv()))
        except (EOFError, BrokenPipeError, ConnectionResetError):
            return


def _task(name: str) -> Callable[..., Any]:
    if name == "line":
        from .perform import perform_line

        return perform_line
    from .text_task import perform_text

    return perform_text


if __name__ == "__main__":
    serve(int(sys.argv[1]), sys.argv[2])
