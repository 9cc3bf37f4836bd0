"""Jobs on a cluster of machines, by Ray: tasks of many lines, given to another machine if one is lost.

A task performs its lines in a worker of its own, which outlives it: so a line that hangs or
ends its process is dealt with there, as on one machine. Files are read and written where the task runs: they
must be on a disk that all machines share, or elsewhere (`s3://…`). Nothing here is loaded unless it is asked
for.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import InputError
from .executors import LocalPool, Performed
from .jobs import BatchJob
from .outcome import Outcome
from .places import size_of

LINES, RETRIES = 16, 3
"""Lines in a task, and how often a task is given to another machine."""
_AHEAD = 2  # tasks that wait for each processor


class RayCluster:
    """Performs jobs on the Ray cluster at `address`, `lines` in a task: "auto" for the one of this machine,
    "local" for one that is started here with `processes` and ends with the run.

    Raises InputError if Ray is not installed or the cluster does not exist.
    """

    def __init__(
        self, address: str, processes: int, seconds: float, run: str = "", lines: int = LINES
    ) -> None:
        self._ray = _connected(address, processes)
        self._seconds, self._run, self._lines = seconds, run, lines
        about = {"num_cpus": 1, "max_retries": RETRIES}
        self._perform = self._ray.remote(**about)(perform_lines)
        self._most = _AHEAD * max(1, int(self._ray.cluster_resources().get("CPU", 1)))
        self._gathered: list[BatchJob] = []
        self._tasks: dict[Any, list[BatchJob]] = {}

    @property
    def full(self) -> bool:
        """Whether enough tasks wait."""
        return len(self._tasks) >= self._most

    @property
    def busy(self) -> bool:
        """Whether outcomes are still to come, of what was flushed too."""
        return bool(self._tasks or self._gathered)

    def submit(self, job: BatchJob) -> None:
        """Have a job performed, with others in one task; the first tasks are small: all begin soon."""
        self._gathered.append(job)
        if len(self._gathered) >= (self._lines if self.full or len(self._tasks) > self._most // 2 else 2):
            self.flush()

    def flush(self) -> None:
        """Make a task of the jobs that were gathered."""
        if self._gathered:
            task = self._perform.remote(self._gathered, self._seconds, self._run)
            self._tasks[task] = self._gathered
            self._gathered = []

    def results(self, *, block: bool) -> Performed:
        """Yield the outcomes of the tasks that are done."""
        if not self._tasks:
            return
        done, _ = self._ray.wait(list(self._tasks), timeout=None if block else 0)
        for task in done:
            jobs = self._tasks.pop(task)
            yield from zip(jobs, self._outcomes(task, jobs), strict=True)

    def close(self) -> None:
        """Give up the tasks that are not done, and leave the cluster."""
        for task in self._tasks:
            self._ray.cancel(task, force=True)
        self._tasks.clear()
        self._ray.shutdown()

    def _outcomes(self, task: Any, jobs: Sequence[BatchJob]) -> list[Outcome]:
        try:
            outcomes: list[Outcome] = self._ray.get(task)
        except self._ray.exceptions.RayError as error:
            reason = str(error).strip().splitlines()[0]
            return [Outcome(error=f"Ray lost its task {RETRIES + 1} times: {reason}") for _ in jobs]
        return [_visible(outcome) for outcome in outcomes]


def _visible(outcome: Outcome) -> Outcome:
    """Return the outcome; one with an error if its files were written where the run cannot see them."""
    for name, size in outcome.outputs.items():
        if size_of(name) != size:
            return Outcome(error=f"{name} was written on another machine; expected a shared disk or s3://…")
    return outcome


def perform_lines(jobs: Sequence[BatchJob], seconds: float, run: str) -> list[Outcome]:
    """Perform the lines of a task; this runs in a process of Ray's."""
    process = _process(seconds, run)
    outcomes: dict[str, Outcome] = {}
    for job in jobs:
        process.submit(job)
        outcomes |= {done.id: outcome for done, outcome in process.results(block=True)}
    return [outcomes[job.id] for job in jobs]


@cache
def _process(seconds: float, run: str) -> LocalPool:
    return LocalPool(1, seconds, run)


def _connected(address: str, processes: int) -> Any:
    """Return the module `ray`, connected."""
    try:
        import ray
    except ImportError:
        raise InputError("--ray needs Ray; run pip install ray") from None
    package = str(Path(__file__).parents[2])
    path = os.pathsep.join(filter(None, (package, os.environ.get("PYTHONPATH", ""))))
    about: dict[str, Any] = {"log_to_driver": False, "logging_level": "ERROR"}
    about["runtime_env"] = {"env_vars": {"PYTHONPATH": path}}
    if address == "local":
        about |= {"num_cpus": processes, "include_dashboard": False}
    else:
        about |= {"address": address}
    try:
        ray.init(**about)
    except (ConnectionError, RuntimeError, ValueError) as error:
        reason = str(error).strip().splitlines()[0]
        raise InputError(
            f"no Ray cluster at '{address}': {reason}; expected auto, local or HOST:PORT"
        ) from None
    return ray
