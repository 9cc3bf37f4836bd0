"""The program of a worker: it does tasks for the process that started it (`workers`), until that is gone.

It is run as a file, needs the standard library alone and imports nothing of Risorius. So it starts fast, and
a library under the GPL shares its process with the task that needs it and with nothing else.
"""

from __future__ import annotations

import importlib.util
import os
import pickle
import signal
import socket
import struct
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from types import ModuleType
from typing import Any

ITEM, DONE, FAILED = "item", "done", "failed"
"""Kinds of answers: an item that a task tells on its way, its result, or a RisoriusError."""
_LENGTH = struct.Struct("<Q")
_ERRORS = "risorius.errors"


def send(connection: socket.socket, message: object) -> None:
    """Send a message; blocks until the other side has taken it. Raises OSError if that is gone."""
    data = pickle.dumps(message, pickle.HIGHEST_PROTOCOL)
    connection.sendall(_LENGTH.pack(len(data)) + data)


def receive(connection: socket.socket) -> Any:
    """Return the next message; blocks until it is whole. Raises EOFError if the other side is gone."""
    (length,) = _LENGTH.unpack(_read(connection, _LENGTH.size))
    return pickle.loads(_read(connection, length))


def _read(connection: socket.socket, length: int) -> bytearray:
    data = bytearray(length)
    remaining = memoryview(data)
    while remaining:
        count = connection.recv_into(remaining)
        if not count:
            raise EOFError("the other process is gone")
        remaining = remaining[count:]
    return data


def function_of(task: str) -> Callable[..., Any]:
    """Return the function that a task names: "package.module:function", or "/folder/file.py:function"."""
    source, _, name = task.rpartition(":")
    function: Callable[..., Any] = getattr(_module(source), name)
    return function


@cache
def _module(source: str) -> ModuleType:
    """Return a module; a file is loaded without the packages around it."""
    if not source.endswith(".py"):
        return importlib.import_module(source)
    name = os.path.basename(source).removesuffix(".py")  # noqa: PTH119 - pathlib takes longer than the rest
    spec = importlib.util.spec_from_file_location(name, source)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def serve(connection: socket.socket) -> None:
    """Do tasks until the connection is closed."""
    with suppress(EOFError, ConnectionError):
        while True:
            send(connection, _answer(connection, *receive(connection)))


def _answer(connection: socket.socket, task: str, arguments: Sequence[Any] | None, tells: bool) -> Any:
    """Do a task, or only load it if there are no `arguments`. One that `tells` can send items on its way.

    An error that is not Risorius' own is not foreseen: it ends the process.
    """
    function = function_of(task)
    if arguments is None:
        return DONE, None
    first = (lambda item: send(connection, (ITEM, item)),) if tells else ()
    try:
        return DONE, function(*first, *arguments)
    except Exception as error:
        if type(error).__module__ != _ERRORS:
            raise
        return FAILED, error


def main() -> None:
    """Serve over the socket that the first argument numbers, or that Windows describes on standard input."""
    # Ctrl-C reaches the whole process group: the process that asked decides what becomes of this one.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform == "win32":
        connection = socket.fromshare(sys.stdin.buffer.read())
    else:
        connection = socket.socket(fileno=int(sys.argv[1]))
    with connection:
        serve(connection)


if __name__ == "__main__":
    main()
