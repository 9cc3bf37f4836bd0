"""Processes of our own that do tasks for this one, and what becomes of a task whose process dies or hangs.

A worker is a program beside this one (`worker.py`), not a fork: numpy finds the number of its threads
when it is loaded, and a user's script is not run again in each worker. A socket connects the two.
A request is the name of a task, "package.module:function" or "/folder/file.py:function", and its arguments.
The answer is what the function returns, or the RisoriusError that it raises; before it come the items that
the task tells on its way. All of this is pickled. What is large and comes often, as the pictures of a film,
goes through memory that both processes map.

- No request waits without a limit. A worker that gives no answer in time is killed.
- A worker that dies, for whatever reason, is a WorkerError, which says how it ended and its last complaint.
- After a WorkerError the worker is gone. `LastingWorker` and `worker_pool` start another and repeat the
  request once; other users repeat what they have to, as a whole film.
- A worker ignores interrupts. It ends when it is closed, and when this process ends, in whatever way.
"""

from __future__ import annotations

import atexit
import os
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any, Self

from .worker import DONE, FAILED, receive, send

SECONDS = 60.0
"""How long a request may take if nothing else is said."""
_STEP = 0.5  # s: a time limit is waited for in such steps, so that time in which we are stopped counts little
_LAST_WORDS = 4_000  # bytes of what a worker complains of that are read
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


class WorkerError(Exception):
    """A worker died, gave no answer in time, or could not be started; the message says which and why."""


class Worker:
    """One process that does one task after another. Use as a context manager, or close it.

    `threads`: how many it may draw with; linear algebra then has one. None: as many as this process.
    Raises WorkerError if it cannot be started.
    """

    def __init__(self, threads: int | None = None) -> None:
        self._lock = threading.RLock()
        self._complaints = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as the process
        ours, theirs = socket.socketpair()
        self.connection = ours
        self.is_closed = False
        with theirs:
            try:
                self._process = _started(theirs, self._complaints, threads)
            except OSError as error:
                ours.close()
                self._complaints.close()
                raise WorkerError(f"could not be started: {error}") from error

    @property
    def pid(self) -> int:
        """The process' number."""
        return self._process.pid

    def load(self, task: str) -> None:
        """Let the worker import a task's module; the answer is None."""
        self._send((task, None, False), SECONDS)

    def send(self, task: str, *arguments: object, tells: bool = False, seconds: float = SECONDS) -> None:
        """Ask for a task, and do not wait for the answer; answers come in the order of requests.

        `tells`: the function's first argument is a function that sends an item.
        """
        self._send((task, arguments, tells), seconds)

    def answer(self, seconds: float = SECONDS) -> Any:
        """Return the next answer; raise the RisoriusError that it is."""
        kind, value = self._receive(seconds)
        if kind == FAILED:
            raise value
        return value

    def items(self, seconds: float = SECONDS) -> Generator[Any, None, Any]:
        """Yield the items of a task as they come, each within `seconds`; return the answer."""
        while True:
            kind, value = self._receive(seconds)
            if kind == FAILED:
                raise value
            if kind == DONE:
                return value
            yield value

    def call(self, task: str, *arguments: object, seconds: float = SECONDS) -> Any:
        """Return the answer to a request."""
        with self._lock:
            self.send(task, *arguments, seconds=seconds)
            return self.answer(seconds)

    def has_come(self) -> bool:
        """Whether an item, an answer or the end of the worker can be noticed without waiting."""
        try:
            self.connection.settimeout(0.0)
            self.connection.recv(1, socket.MSG_PEEK)
        except BlockingIOError:
            return False
        except OSError:
            pass
        return True

    def close(self) -> None:
        """End the worker at once: it has nothing to lose."""
        self.is_closed = True
        self._process.kill()
        self._process.wait()
        with self._lock:  # a thread that waits for an answer first notices the end
            self.connection.close()
            self._complaints.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _send(self, message: object, seconds: float) -> None:
        with self._limited(seconds):
            self.connection.settimeout(seconds)
            send(self.connection, message)

    def _receive(self, seconds: float) -> tuple[str, Any]:
        with self._limited(seconds):
            self._wait(seconds)
            self.connection.settimeout(seconds)
            kind, value = receive(self.connection)
        return kind, value

    def _wait(self, seconds: float) -> None:
        """Wait until something comes."""
        while True:
            self.connection.settimeout(min(seconds, _STEP))
            try:
                self.connection.recv(1, socket.MSG_PEEK)
            except (TimeoutError, BlockingIOError):
                seconds -= _STEP
                if seconds <= 0.0:
                    raise
            else:
                return

    @contextmanager
    def _limited(self, seconds: float) -> Iterator[None]:
        """Make a WorkerError of whatever goes wrong, after which the worker is gone."""
        with self._lock:
            try:
                yield
            except (TimeoutError, BlockingIOError):
                self.close()
                raise WorkerError(f"gave no answer within {seconds:g} s") from None
            except (OSError, EOFError):
                reason = self._ending()
                self.close()
                raise WorkerError(f"ended without an answer{reason}") from None
            except BaseException:
                # Interrupted: a late answer must never be taken for that of the next request.
                self.close()
                raise

    def _ending(self) -> str:
        """Say how the process ended, and the last line that it complained of."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(timeout=1.0)
        status = self._process.poll()
        if status is None:
            return ""
        how = f" (signal {-status})" if status < 0 else f" (exit code {status})"
        complaint = "" if self._complaints.closed else last_line(self._complaints)
        return f"{how}: {complaint}" if complaint else how


class LastingWorker:
    """A worker that threads share: started when it is first needed, and replaced if it fails.

    A request that it fails is repeated once. A forked process gets a worker of its own.
    """

    def __init__(self) -> None:
        self._lock = threading.RLock()
        self._worker: Worker | None = None
        self._owner = os.getpid()

    @property
    def pid(self) -> int | None:
        """The process' number, None before the worker starts."""
        return None if self._worker is None else self._worker.pid

    def call(self, task: str, *arguments: object, seconds: float = SECONDS) -> Any:
        """Return the answer to a request; raise WorkerError if it failed twice."""
        with self._lock:
            with suppress(WorkerError):
                return self._running().call(task, *arguments, seconds=seconds)
            return self._running().call(task, *arguments, seconds=seconds)

    def close(self) -> None:
        """End the worker; a later call starts another."""
        with self._lock:
            if self._worker is not None and self._owner == os.getpid():
                self._worker.close()
            self._worker = None
        atexit.unregister(self.close)

    def _running(self) -> Worker:
        # A fork inherits the socket of its parent's worker; it must not talk into it.
        if self._worker is None or self._worker.is_closed or self._owner != os.getpid():
            self._owner, self._worker = os.getpid(), Worker()
            atexit.unregister(self.close)
            atexit.register(self.close)
        return self._worker


def _started(
    connection: socket.socket, complaints: IO[bytes], threads: int | None
) -> subprocess.Popen[bytes]:
    """Start a worker, which finds the same modules as this process, but none in the current folder."""
    package = str(Path(__file__).parents[2])  # it may have been found in the current folder
    variables = {"PYTHONPATH": os.pathsep.join([*(entry for entry in sys.path if entry), package])}
    if threads is not None:
        variables |= dict.fromkeys(_THREADS, "1") | {"RISORIUS_THREADS": str(threads)}
    command = [sys.executable, "-P", str(Path(__file__).with_name("worker.py"))]
    options: dict[str, Any] = {"env": os.environ | variables, "stdout": complaints, "stderr": complaints}
    if sys.platform == "win32":
        process = subprocess.Popen(command, stdin=subprocess.PIPE, **options)
        with process.stdin as pipe:
            pipe.write(connection.share(process.pid))
        return process
    number = connection.fileno()
    return subprocess.Popen([*command, str(number)], stdin=subprocess.DEVNULL, pass_fds=[number], **options)


def last_line(complaints: IO[bytes]) -> str:
    """Return the last line of a file of complaints."""
    complaints.seek(max(0, complaints.seek(0, os.SEEK_END) - _LAST_WORDS))
    lines = complaints.read().decode("utf-8", "replace").strip().splitlines()
    return lines[-1].strip() if lines else ""
