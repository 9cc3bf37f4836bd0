"""Executors of jobs: this process, processes on this machine, or a cluster (`ray_cluster`)."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Protocol

from ..machine.worker_pool import Lost, WorkerPool
from .jobs import BatchJob
from .outcome import Outcome

Performed = Iterator[tuple[BatchJob, Outcome]]


class BatchExecutor(Protocol):
    """Performs jobs in any order. All calls come from one thread."""

    @property
    def full(self) -> bool:
        """Whether no more jobs should be submitted before some are done."""

    @property
    def busy(self) -> bool:
        """Whether outcomes are still to come."""

    def submit(self, job: BatchJob) -> None:
        """Have a job performed."""

    def results(self, *, block: bool) -> Performed:
        """Yield jobs that are done with their outcomes; with `block`, wait for one at least."""

    def flush(self) -> None:
        """Begin with all that was submitted: no more comes."""

    def close(self) -> None:
        """End all work at once."""


class InProcess:
    """Performs jobs in this process, one after the other."""

    def __init__(self, run: str = "") -> None:
        self._run = run
        self._waiting: deque[BatchJob] = deque()

    @property
    def full(self) -> bool:
        """Whether a job waits."""
        return bool(self._waiting)

    @property
    def busy(self) -> bool:
        """Whether a job waits."""
        return bool(self._waiting)

    def submit(self, job: BatchJob) -> None:
        """Have a job performed when results are asked for."""
        self._waiting.append(job)

    def results(self, *, block: bool) -> Performed:
        """Perform a job with `block`, and yield its outcome."""
        from .perform import perform_line

        if block and self._waiting:
            job = self._waiting.popleft()
            yield job, perform_line(job, self._run)

    def flush(self) -> None:
        """Do nothing: jobs are performed when results are asked for."""

    def close(self) -> None:
        """Forget the jobs that wait."""
        self._waiting.clear()


class LocalPool:
    """Performs jobs by `processes` of this machine, each within `seconds`."""

    def __init__(self, processes: int, seconds: float, run: str = "") -> None:
        self._run = run
        self.pool = WorkerPool("risorius.batches.perform:perform_line", processes, seconds)
        self.pool.start()

    @property
    def full(self) -> bool:
        """Whether each process has a job, and one more waits."""
        return self.pool.full

    @property
    def busy(self) -> bool:
        """Whether outcomes are still to come."""
        return self.pool.busy

    def submit(self, job: BatchJob) -> None:
        """Have a job performed."""
        self.pool.submit(job, job, self._run)

    def results(self, *, block: bool) -> Performed:
        """Yield the outcomes that are there; a job whose process ended or hung has failed."""
        for job, answer in self.pool.results(block=block):
            yield job, Outcome(error=answer.reason) if isinstance(answer, Lost) else answer

    def flush(self) -> None:
        """Do nothing: jobs are handed out as they come."""

    def close(self) -> None:
        """End the processes."""
        self.pool.close()
