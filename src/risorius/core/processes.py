"""Processes beside this one: programs of the package, and foreign ones, timed, bounded and never waited for
for ever.
"""

from __future__ import annotations

import contextlib
import os
import socket
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .frozen import FrozenDict

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

LOOK = 0.5  # s between two looks at a process that does not answer
_STOPPED = 4  # looks at which it stands still in succession: then nobody continues it


class SilentError(Exception):
    """A process does not answer; the message says why it is given up."""


def processors() -> int:
    """Return how many processors this process may use: at most RISORIUS_THREADS if that is set."""
    most = os.environ.get("RISORIUS_THREADS", "")
    return min(_processors(), int(most)) if most.isdecimal() and int(most) else _processors()


def _processors() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def start(
    module: str, *arguments: str, variables: Mapping[str, str] = FrozenDict(), **options: Any
) -> subprocess.Popen[bytes]:
    """Start `python -m module`, which finds the same modules as this process, but none in the current folder.

    `variables` are added to the environment; `options` are those of `subprocess.Popen`.
    """
    # Our own package may have been found in the current folder.
    paths = os.pathsep.join([*(entry for entry in sys.path if entry), str(Path(__file__).parents[2])])
    command = [sys.executable, "-P", "-m", module, *arguments]
    return subprocess.Popen(command, env={**os.environ, **variables, "PYTHONPATH": paths}, **options)


def start_connected(
    module: str, *arguments: str, **options: Any
) -> tuple[subprocess.Popen[bytes], Connection]:
    """Start a module as `start` does, with the number of a socket as its first argument.

    Returned are the process and the connection to it. Raises ValueError where no process inherits a socket.
    """
    from multiprocessing.connection import Connection

    ours, theirs = socket.socketpair()
    with theirs:
        process = start(
            module,
            str(theirs.fileno()),
            *arguments,
            stdin=subprocess.DEVNULL,
            pass_fds=[theirs.fileno()],
            **options,
        )
    return process, Connection(ours.detach())


def end_connected(process: subprocess.Popen[bytes], connection: Connection, seconds: float) -> int:
    """End a process that has a connection, unless it ends within `seconds`; return its exit status."""
    connection.close()
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(timeout=seconds)
    process.kill()
    return process.wait()


def patience(pid: int, seconds: float) -> Iterator[float]:
    """Yield how long to wait for a process next; raise SilentError after `seconds`, or if it stands still.

    Time in which this process itself was stopped does not count.
    """
    waited, watch = 0.0, Watch(pid)
    while waited < seconds:
        step = min(LOOK, seconds - waited)
        yield step
        waited += step
        watch.look()
    raise SilentError(f"gave no answer within {seconds:g} s")


class Watch:
    """Looks now and then whether a process stands still."""

    def __init__(self, pid: int) -> None:
        self._pid, self._still = pid, 0

    def look(self) -> None:
        """Look, `LOOK` seconds after the last time; raise SilentError if it stands still for long."""
        self._still = self._still + 1 if is_stopped(self._pid) else 0
        if self._still == _STOPPED:
            raise SilentError("was stopped by a signal and does not go on")


def is_stopped(pid: int) -> bool:
    """Whether a process was stopped by a signal (SIGSTOP); False if the system does not say."""
    try:
        return Path(f"/proc/{pid}/stat").read_bytes().rpartition(b")")[2].split()[0] == b"T"
    except (OSError, IndexError):
        return False
