"""Warm processes on this machine: each loads what a line needs once, and is replaced when it ends or hangs.

They are programs of their own, not forks: numpy and numba must find the number of their threads when they are
loaded, and a caller's script is not run again in each of them.
"""

from __future__ import annotations

import contextlib
import os
import threading
import time
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import wait
from typing import Any

from ..core.processes import LOOK, SilentError, Watch, end_connected, start_connected
from ..errors import RisoriusError
from .worker import READY

MOST_MEMORY = 1_500_000_000  # bytes that a process may hold between two lines
MOST_LOSSES = 2  # processes that end while they perform one line, before it is given up
STARTING = 120.0  # seconds that a process may take to load
_PROGRAM = "risorius.batches.worker"
_THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


@dataclass(frozen=True, slots=True)
class Lost:
    """What comes back for a request whose process ended or took too long; `reason` says which."""

    reason: str


@dataclass
class _Request:
    key: Any
    arguments: tuple[Any, ...]
    losses: int = 0


class _Worker:
    """One process and the request that it is at; it has `threads` to draw with, and one for all else."""

    def __init__(self, task: str, threads: int) -> None:
        variables = dict.fromkeys(_THREADS, "1") | {"RISORIUS_THREADS": str(threads)}
        self.process, self.connection = start_connected(_PROGRAM, task, variables=variables)
        self._watch, self._looked = Watch(self.process.pid), time.monotonic()
        self.request: _Request | None = None
        self.ready = False
        self.since = time.monotonic()

    def send(self, request: _Request) -> None:
        self.request, self.since = request, time.monotonic()
        # A process that stands still takes nothing: nobody waits for it here.
        threading.Thread(target=self._send, args=(request.arguments,), daemon=True).start()

    def _send(self, arguments: tuple[Any, ...]) -> None:
        # That it has ended, or was closed meanwhile, is noticed when it is waited for.
        with contextlib.suppress(OSError, TypeError):
            self.connection.send(arguments)

    def look(self) -> None:
        """Look at times whether it stands still; raise SilentError if it does."""
        now = time.monotonic()
        if now - self._looked >= LOOK:
            self._looked = now
            self._watch.look()

    def end(self, patience: float = 0.0) -> str:
        """End the process, unless it does within seconds of `patience`; return how it ended."""
        code = end_connected(self.process, self.connection, patience)
        return f"signal {-code}" if code < 0 else f"exit code {code}"

    def close(self) -> None:
        self.end(patience=2.0)


class WorkerPool:
    """Up to `size` processes for a `task` ("line" or "text"), each request within `seconds`.

    A request whose process ends is given to a new one once more; then it is lost.
    """

    def __init__(self, task: str, size: int, seconds: float = 600.0) -> None:
        self._task, self._size, self._seconds = task, size, seconds
        self._threads = max(1, (os.cpu_count() or 1) // size)
        self._workers: list[_Worker] = []
        self._waiting: deque[_Request] = deque()
        self._lost: deque[tuple[Any, Lost]] = deque()
        self._failed_starts = 0  # in a row

    @property
    def full(self) -> bool:
        """Whether each process has something to do, and one more request waits."""
        return len(self._waiting) > 0 and self._at_work() >= self._size

    @property
    def busy(self) -> bool:
        """Whether results are still to come."""
        return bool(self._waiting or self._at_work())

    @property
    def processes(self) -> tuple[int, ...]:
        """The numbers of the processes."""
        return tuple(worker.process.pid for worker in self._workers)

    def start(self) -> None:
        """Start all processes, so that they load while there is nothing to do yet."""
        while len(self._workers) < self._size:
            self._workers.append(_Worker(self._task, self._threads))

    def submit(self, key: Any, *arguments: Any) -> None:
        """Have a request answered; `key` comes back with its result."""
        self._waiting.append(_Request(key, arguments))
        self._hand_out()

    def results(self, *, block: bool = True) -> Iterator[tuple[Any, Any]]:
        """Yield keys with results, or `Lost`, as they are there; with `block`, wait for one at least."""
        while True:
            pairs = list(self._collected(self._patience() if block else 0.0))
            self._hand_out()
            yield from pairs
            if pairs or not block or not self.busy:
                return

    def close(self) -> None:
        """End all processes at once, those at work too."""
        for worker in self._workers:
            worker.end() if worker.request is not None or not worker.ready else worker.close()
        self._workers.clear()
        self._waiting.clear()

    def __enter__(self) -> WorkerPool:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _at_work(self) -> int:
        return sum(worker.request is not None for worker in self._workers)

    def _hand_out(self) -> None:
        while self._waiting:
            idle = next((worker for worker in self._workers if worker.request is None), None)
            if idle is None and len(self._workers) < self._size:
                idle = _Worker(self._task, self._threads)
                self._workers.append(idle)
            if idle is None:
                return
            idle.send(self._waiting.popleft())

    def _patience(self) -> float:
        """Return the seconds until the next process has taken too long, or is to be looked at."""
        ends = [worker.since + self._limit(worker) for worker in self._workers if worker.request is not None]
        return max(0.0, min(LOOK, min(ends, default=0.0) - time.monotonic()))

    def _limit(self, worker: _Worker) -> float:
        return self._seconds if worker.ready else self._seconds + STARTING

    def _collected(self, seconds: float) -> Iterator[tuple[Any, Any]]:
        by_connection = {worker.connection: worker for worker in self._workers}
        for connection in wait(list(by_connection), seconds):
            worker = by_connection[connection]  # type: ignore[index]
            try:
                answer = worker.connection.recv()
            except (EOFError, OSError):
                yield from self._replace(
                    worker, f"its process ended ({worker.end(patience=1.0)})", again=True
                )
                continue
            if not worker.ready:
                worker.ready, worker.since = answer == READY, time.monotonic()
                self._failed_starts = 0
            elif worker.request is not None:
                yield self._finished(worker), answer
                if getattr(answer, "memory", 0) > MOST_MEMORY:
                    worker.close()
                    self._workers.remove(worker)
        now = time.monotonic()
        for worker in [w for w in self._workers if w.request is not None]:
            if now - worker.since > self._limit(worker):
                worker.end()
                yield from self._replace(worker, f"took longer than {self._seconds:g} s", again=False)
                continue
            try:
                worker.look()
            except SilentError as error:
                worker.end()
                yield from self._replace(worker, f"its process {error}", again=True)

    def _finished(self, worker: _Worker) -> Any:
        assert worker.request is not None
        key, worker.request = worker.request.key, None
        return key

    def _replace(self, worker: _Worker, reason: str, *, again: bool) -> Iterator[tuple[Any, Lost]]:
        """Drop a process that has ended; its request goes to another, or is lost."""
        self._workers.remove(worker)
        self._failed_starts += not worker.ready
        if self._failed_starts > MOST_LOSSES * self._size:
            raise RisoriusError(
                f"processes cannot be started: {reason}; expected enough memory, or fewer --jobs"
            )
        request = worker.request
        if request is None:
            return
        request.losses += worker.ready  # a process that never began has not lost it
        if again and request.losses < MOST_LOSSES:
            self._waiting.appendleft(request)
        else:
            yield request.key, Lost(reason)
