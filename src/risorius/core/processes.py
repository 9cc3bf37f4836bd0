"""Processes beside this one: programs of the package, and foreign ones, timed, bounded and never waited for
for ever.
"""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from .frozen import FrozenDict

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

LOOK = 0.5  # s between two looks at a process that does not answer
_STOPPED = 4  # looks at which it stands still in succession: then nobody continues it
_LAST_WORDS = 4_000  # bytes of what a program complains of that are read


class SilentError(Exception):
    """A process does not answer; the message says why it is given up."""


class TooLongError(Exception):
    """A program answers with more bytes than it may."""


@dataclass(frozen=True, slots=True)
class Finished:
    """A program that has ended: its exit status, its output, and the last line that it complained of."""

    status: int
    output: bytes
    complaint: str


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


def run(command: Sequence[str], data: bytes, seconds: float, largest: int) -> Finished:
    """Run a foreign program with `data` on its input, and return what it prints.

    After that none of its processes is left. Raises OSError if it cannot be started, SilentError if it takes
    longer than `seconds`, and TooLongError if it prints more than `largest` bytes.
    """
    with tempfile.TemporaryFile() as complaints:
        process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=complaints,
            start_new_session=True,
        )
        assert process.stdin is not None
        assert process.stdout is not None
        output = bytearray()
        feeder = threading.Thread(target=_feed, args=(process.stdin, data), daemon=True)
        reader = threading.Thread(target=_collect, args=(process.stdout, output, largest), daemon=True)
        try:
            feeder.start()
            reader.start()
            for step in patience(process.pid, seconds):
                reader.join(step)
                if not reader.is_alive() and (len(output) > largest or _has_ended(process, step)):
                    break
            if len(output) > largest:
                raise TooLongError(f"printed more than {largest // 1_000_000} MB")
            return Finished(process.wait(), bytes(output), _last_line(complaints))
        finally:
            _end(process)
            for thread in (feeder, reader):
                thread.join(timeout=1.0)


def _feed(pipe: IO[bytes], data: bytes) -> None:
    with contextlib.suppress(OSError), pipe:
        pipe.write(data)


def _collect(pipe: IO[bytes], output: bytearray, largest: int) -> None:
    with contextlib.suppress(OSError, ValueError), pipe:
        while len(output) <= largest and (piece := os.read(pipe.fileno(), 65_536)):
            output += piece


def _has_ended(process: subprocess.Popen[bytes], seconds: float) -> bool:
    try:
        process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        return False
    return True


def _last_line(complaints: IO[bytes]) -> str:
    complaints.seek(max(0, complaints.seek(0, os.SEEK_END) - _LAST_WORDS))
    lines = complaints.read().decode("utf-8", "replace").strip().splitlines()
    return lines[-1].strip() if lines else ""


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a program and all that it has started; on Windows, which has no groups of them, the program."""
    if sys.platform != "win32":
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()
    process.wait()
