"""A process that performs for live faces: the program that `beside` starts."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .performer import LocalPerformer

READY = "ready"
_NICE = 5


def serve(descriptor: int) -> None:
    """Answer requests that come through a socket, until its other end is closed."""
    # Whoever interrupts the server interrupts its own process; that ends this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # A frame that is due goes before a sentence that is to join.
    if hasattr(os, "nice"):
        os.nice(_NICE)
    performer = _warm()
    with Connection(descriptor) as connection:
        try:
            connection.send(READY)
            while True:
                task, arguments = connection.recv()
                connection.send(_answer(performer, task, arguments))
        except (EOFError, BrokenPipeError, ConnectionResetError):
            return


def _warm() -> LocalPerformer:
    """Return a performer that has loaded what the first request would wait for."""
    from ..errors import RisoriusError
    from ..settings import Settings
    from .performer import LocalPerformer

    performer = LocalPerformer()
    with contextlib.suppress(RisoriusError):  # whoever asks is told
        performer.text("Hello.", (), Settings())
    return performer


def _answer(performer: LocalPerformer, task: str, arguments: tuple[object, ...]) -> object:
    from ..errors import RisoriusError

    try:
        return getattr(performer, task)(*arguments)
    except RisoriusError as error:
        return error


if __name__ == "__main__":
    serve(int(sys.argv[1]))
