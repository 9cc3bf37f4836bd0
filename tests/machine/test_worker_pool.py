"""A pool of workers: one that ends is replaced, a request that ends two or takes too long is lost."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from risorius.errors import InputError, RisoriusError
from risorius.machine import worker_pool
from risorius.machine.worker_pool import Lost, WorkerPool, resident

TASKS = str(Path(__file__).with_name("tasks.py"))
posix = pytest.mark.skipif(os.name != "posix", reason="needs POSIX signals")


def pool(task: str, size: int = 1, seconds: float = 60.0) -> WorkerPool:
    return WorkerPool(f"{TASKS}:{task}", size, seconds)


def answers(workers: WorkerPool) -> Iterator[tuple[object, object]]:
    while workers.busy:
        yield from workers.results()


def test_each_request_has_its_answer() -> None:
    with pool("echo", 2) as workers:
        workers.start()
        assert not workers.busy
        for number in range(5):
            workers.submit(number, "a", number)
        assert workers.full
        assert dict(answers(workers)) == {number: ("a", number) for number in range(5)}
        assert len(workers.processes) == 2


def test_an_error_of_ours_is_an_answer() -> None:
    with pool("refuse") as workers:
        workers.submit("a")
        ((_, error),) = answers(workers)
        assert isinstance(error, InputError)


@posix
def test_a_request_whose_worker_ends_is_repeated_once(tmp_path: Path) -> None:
    with pool("once") as workers:
        workers.submit("a", str(tmp_path / "mark"), "kill")
        assert dict(answers(workers)) == {"a": workers.processes[0]}
    with pool("kill") as workers:
        workers.submit("a")
        assert dict(answers(workers)) == {"a": Lost("its process ended without an answer (signal 9)")}


@posix
def test_an_idle_worker_that_has_ended_is_replaced() -> None:
    with pool("echo") as workers:
        workers.submit(1)
        list(answers(workers))
        (first,) = workers.processes
        os.kill(first, 9)
        workers.submit(2)
        assert dict(answers(workers)) == {2: ()}
        assert workers.processes != (first,)


@posix
def test_a_request_that_takes_too_long_is_lost() -> None:
    with pool("hang", seconds=0.2) as workers:
        workers.submit("a")
        assert dict(answers(workers)) == {"a": Lost("took longer than 0.2 s")}


def test_a_worker_that_holds_much_memory_is_replaced(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(worker_pool, "MOST_MEMORY", 0)
    with pool("echo") as workers:
        workers.submit(1)
        list(answers(workers))
        assert workers.processes == () or not resident(os.getpid())


@pytest.mark.parametrize("task", ["no.such.module:f", f"{TASKS}:no_such_function"])
def test_a_task_that_cannot_be_loaded_is_one_error(task: str) -> None:
    with WorkerPool(task, 1) as workers:
        workers.submit("a")
        with pytest.raises(RisoriusError, match=r"cannot be started: its process ended .*\(exit code 1\)"):
            list(answers(workers))
