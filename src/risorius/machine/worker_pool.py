"""Several workers for many requests of one kind: each is loaded once, and replaced when it ends or hangs."""

from __future__ import annotations

import mmap
import os
import time
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any, Self

from ..errors import RisoriusError
from .workers import Worker, WorkerError

MOST_MEMORY = 1_500_000_000  # bytes that a worker may hold between two requests
MOST_LOSSES = 2  # workers that end while they answer one request, before it is given up
STARTING = 120.0  # seconds that a worker may take to load


@dataclass(frozen=True, slots=True)
class Lost:
    """Comes back for a request whose worker ended or took too long; `reason` says which."""

    reason: str


@dataclass
class _Request:
    key: Any
    arguments: tuple[Any, ...]
    losses: int = 0


class _Place:
    """One worker and the request that it is at."""

    def __init__(self, task: str, threads: int) -> None:
        self._task, self.worker = task, Worker(threads)
        self.request: _Request | None = None
        self.ready = False
        self.failure = ""
        self.since = time.monotonic()
        try:
            self.worker.load(task)
        except WorkerError as error:
            self.failure = str(error)

    def send(self, request: _Request) -> None:
        self.request, self.since = request, time.monotonic()
        try:
            self.worker.send(self._task, *request.arguments)
        except WorkerError as error:
            self.failure = str(error)


class WorkerPool:
    """Up to `size` workers for a `task`, each request within `seconds`.

    An error that a task raises is its result. A request whose worker ends is given to a new one once more;
    then it is lost. A worker that holds more than `MOST_MEMORY` after a request is replaced.
    """

    def __init__(self, task: str, size: int, seconds: float = 600.0) -> None:
        self._task, self._size, self._seconds = task, size, seconds
        self._threads = max(1, (os.cpu_count() or 1) // size)
        self._places: list[_Place] = []
        self._waiting: deque[_Request] = deque()
        self._failed_starts = 0  # in a row

    @property
    def full(self) -> bool:
        """Whether each worker has something to do, and one more request waits."""
        return len(self._waiting) > 0 and self._at_work() >= self._size

    @property
    def busy(self) -> bool:
        """Whether results are still to come."""
        return bool(self._waiting or self._at_work())

    @property
    def processes(self) -> tuple[int, ...]:
        """The numbers of the processes."""
        return tuple(place.worker.pid for place in self._places)

    def start(self) -> None:
        """Start all workers, so that they load while there is nothing to do yet."""
        while len(self._places) < self._size:
            self._places.append(self._started())

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
        """End all workers at once, those at work too."""
        for place in self._places:
            place.worker.close()
        self._places.clear()
        self._waiting.clear()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _at_work(self) -> int:
        return sum(place.request is not None for place in self._places)

    def _started(self) -> _Place:
        try:
            return _Place(self._task, self._threads)
        except WorkerError as error:
            raise _no_start(str(error)) from None

    def _hand_out(self) -> None:
        while self._waiting:
            idle = next((place for place in self._places if place.request is None), None)
            if idle is None and len(self._places) < self._size:
                idle = self._started()
                self._places.append(idle)
            if idle is None:
                return
            idle.send(self._waiting.popleft())

    def _patience(self) -> float:
        """Return the seconds until the next worker has taken too long."""
        ends = [place.since + self._limit(place) for place in self._places if place.request is not None]
        return max(0.0, min(ends, default=0.0) - time.monotonic())

    def _limit(self, place: _Place) -> float:
        return self._seconds if place.ready else self._seconds + STARTING

    def _collected(self, seconds: float) -> Iterator[tuple[Any, Any]]:
        failed = [place for place in self._places if place.failure]
        for place in failed:
            yield from self._replace(place, f"its process {place.failure}", again=True)
        by_connection = {place.worker.connection: place for place in self._places}
        for connection in wait(list(by_connection), 0.0 if failed else seconds):
            yield from self._answered(by_connection[connection])  # type: ignore[index]
        now = time.monotonic()
        for place in [p for p in self._places if p.request is not None]:
            if now - place.since > self._limit(place):
                place.worker.close()
                yield from self._replace(place, f"took longer than {self._seconds:g} s", again=False)

    def _answered(self, place: _Place) -> Iterator[tuple[Any, Any]]:
        try:
            answer = place.worker.answer()
        except RisoriusError as error:
            answer = error
        except WorkerError as error:
            yield from self._replace(place, f"its process {error}", again=True)
            return
        if not place.ready:
            place.ready, place.since, self._failed_starts = True, time.monotonic(), 0
        elif place.request is not None:
            yield place.request.key, answer
            place.request = None
            if resident(place.worker.pid) > MOST_MEMORY:
                place.worker.close()
                self._places.remove(place)

    def _replace(self, place: _Place, reason: str, *, again: bool) -> Iterator[tuple[Any, Lost]]:
        """Drop a worker that has ended; its request goes to another, or is lost."""
        self._places.remove(place)
        self._failed_starts += not place.ready
        if self._failed_starts > MOST_LOSSES * self._size:
            raise _no_start(reason)
        request = place.request
        if request is None:
            return
        request.losses += place.ready  # a worker that never began has not lost it
        if again and request.losses < MOST_LOSSES:
            self._waiting.appendleft(request)
        else:
            yield request.key, Lost(reason)


def _no_start(reason: str) -> RisoriusError:
    return RisoriusError(f"processes cannot be started: {reason}; expected enough memory, or fewer --jobs")


def resident(pid: int) -> int:
    """Return the bytes of memory that a process holds, 0 where the system does not say."""
    try:
        pages = int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    except (OSError, ValueError, IndexError):
        return 0
    return pages * mmap.PAGESIZE
