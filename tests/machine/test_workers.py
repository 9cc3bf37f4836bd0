"""Workers: every way in which one can fail is noticed, and no request waits without a limit."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from risorius.errors import InputError
from risorius.machine import workers
from risorius.machine.workers import LastingWorker, Worker, WorkerError

TASKS = str(Path(__file__).with_name("tasks.py"))
posix = pytest.mark.skipif(os.name != "posix", reason="needs POSIX signals")


LISTS = str(Path(__file__).with_name("lists.py"))


def task(name: str) -> str:
    return f"{TASKS}:{name}"


@pytest.fixture
def worker() -> Iterator[Worker]:
    with Worker() as worker:
        yield worker


@pytest.fixture
def lasting() -> Iterator[LastingWorker]:
    worker = LastingWorker()
    yield worker
    worker.close()


def test_answers_come_in_the_order_of_requests(worker: Worker) -> None:
    values: list[object] = [1, "größer", b"x" * 3_000_000, {"a": (None, 2.5)}]
    for value in values:
        worker.send(task("echo"), value)
    assert [worker.answer() for _ in values] == [(value,) for value in values]


def test_a_module_is_imported_by_its_name(worker: Worker) -> None:
    worker.load("os.path:join")
    assert worker.answer() is None
    assert worker.call("os.path:join", "a", "b") == os.path.join("a", "b")  # noqa: PTH118


def test_items_come_before_the_answer(worker: Worker) -> None:
    worker.send(task("count"), 3, tells=True)
    told = worker.items()
    assert [next(told) for _ in range(3)] == [0, 1, 2]
    with pytest.raises(StopIteration) as end:
        next(told)
    assert end.value.value == "done"


def test_an_error_of_ours_comes_with_its_place_and_the_worker_goes_on(worker: Worker) -> None:
    with pytest.raises(InputError, match=r"^x\.txt:3: is wrong; expected better$"):
        worker.call(task("refuse"))
    assert worker.call(task("echo"), 1) == (1,)


@posix
@pytest.mark.parametrize(
    ("name", "arguments", "reason"),
    [
        ("fail", (), r"\(exit code 1\): ValueError: nobody foresaw it$"),
        ("end", (3,), r"\(exit code 3\)$"),
        ("kill", (), r"\(signal 9\)$"),
        ("missing", (), r"\(exit code 1\): AttributeError"),
    ],
)
def test_a_worker_that_ends_says_how(worker: Worker, name: str, arguments: tuple[int], reason: str) -> None:
    with pytest.raises(WorkerError, match=f"^ended without an answer {reason}"):
        worker.call(task(name), *arguments)
    assert worker.is_closed
    with pytest.raises(WorkerError, match="ended without an answer"):
        worker.call(task("echo"))


@posix
@pytest.mark.parametrize("name", ["hang", "echo"])
def test_a_silent_worker_is_given_up(worker: Worker, name: str) -> None:
    """Also one that does not even read what it is sent, which is more than a socket holds."""
    if name == "echo":
        os.kill(worker.pid, signal.SIGSTOP)
    with pytest.raises(WorkerError, match=r"^gave no answer within 0\.3 s$"):
        worker.call(task(name), *[b"x" * 3_000_000] * (name == "echo"), seconds=0.3)
    assert worker.is_closed


@posix
def test_a_worker_that_ends_in_the_midst_of_an_answer_is_noticed(
    worker: Worker, monkeypatch: pytest.MonkeyPatch
) -> None:
    worker.send(task("echo"), b"x" * 3_000_000)  # more than a socket holds
    while not worker.has_come():
        os.sched_yield()
    os.kill(worker.pid, signal.SIGKILL)
    with pytest.raises(WorkerError, match=r"signal 9"):
        worker.answer()


def test_an_interrupt_ends_the_wait_and_the_worker(worker: Worker, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(workers, "receive", interrupted)
    with pytest.raises(KeyboardInterrupt):
        worker.call(task("echo"))
    assert worker.is_closed


@posix
def test_a_worker_ignores_an_interrupt_of_the_terminal(worker: Worker) -> None:
    assert worker.call(task("interrupted")) == "goes on"


def test_what_can_be_noticed_without_waiting(worker: Worker) -> None:
    worker.call(task("echo"))
    assert not worker.has_come()
    worker.close()
    assert worker.has_come()
    worker.close()


def test_threads_are_counted() -> None:
    with Worker(threads=3) as worker:
        variables = worker.call(task("variables"))
    assert variables["OPENBLAS_NUM_THREADS"] == variables["OMP_NUM_THREADS"] == "1"
    assert variables["RISORIUS_THREADS"] == "3"


def test_a_worker_loads_nothing_of_the_package_and_finds_nothing_in_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "textwrap.py").write_text("raise ImportError('not mine')")
    monkeypatch.chdir(tmp_path)
    with Worker() as worker:
        assert worker.call("textwrap:dedent", " a") == "a"
    with Worker() as worker:
        loaded = worker.call(f"{LISTS}:modules")
        assert not [name for name in loaded if name.split(".")[0] in ("risorius", "numpy")]


@pytest.mark.skipif(sys.platform != "linux", reason="needs Linux")
def test_a_worker_ends_with_the_process_that_started_it() -> None:
    program = f"""
import os, signal
from risorius.machine.workers import Worker
worker = Worker()
worker.call("{TASKS}:echo")
print(worker.pid, flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False
    )
    status = Path(f"/proc/{int(done.stdout)}/stat")
    while status.exists() and b") Z" not in status.read_bytes():
        os.sched_yield()


def test_a_program_that_cannot_be_started(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", "/nowhere/python")
    with pytest.raises(WorkerError, match="could not be started"):
        Worker()


@posix
@pytest.mark.parametrize("way", ["kill", "fail"])
def test_a_lasting_worker_is_replaced_once(tmp_path: Path, lasting: LastingWorker, way: str) -> None:
    lasting.call(task("echo"))
    first = lasting.pid
    assert lasting.call(task("once"), str(tmp_path / "mark"), way) == lasting.pid != first
    with pytest.raises(WorkerError, match="ended"):
        lasting.call(task("always"), way)
    assert lasting.call(task("echo"), 1) == (1,)


@posix
def test_a_lasting_worker_that_hangs_is_given_up(lasting: LastingWorker) -> None:
    with pytest.raises(WorkerError, match="gave no answer"):
        lasting.call(task("hang"), seconds=0.2)
    lasting.close()
    assert lasting.pid is None
    assert lasting.call(task("echo"), 1) == (1,)
