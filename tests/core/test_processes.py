from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from risorius.core.processes import SilentError, TooLongError, patience, run

linux = pytest.mark.skipif(sys.platform != "linux", reason="needs Linux")


def program(text: str) -> list[str]:
    return [sys.executable, "-c", text]


def test_a_program_that_is_none_is_an_error() -> None:
    with pytest.raises(OSError, match="No such file"):
        run(["/none"], b"", 10.0, 100)


@pytest.mark.parametrize(
    "text", ["import time; time.sleep(600)", "import os, time; os.close(1); time.sleep(600)"]
)
def test_a_silent_program_is_given_up(text: str) -> None:
    with pytest.raises(SilentError, match=r"gave no answer within 0\.7 s"):
        run(program(text), b"x" * 1_000_000, 0.7, 100)


def test_an_endless_answer_is_cut() -> None:
    with pytest.raises(TooLongError, match="more than 1 MB"):
        run(program("while True: print('x' * 100_000)"), b"", 60.0, 1_000_000)


@linux
def test_a_stopped_program_is_noticed_and_no_child_of_it_is_left(tmp_path: Path) -> None:
    children = (
        "import os, signal, subprocess, sys; p = subprocess.Popen(['sleep', '600']);"
        f"open({str(tmp_path / 'pid')!r}, 'w').write(str(p.pid)); os.kill(os.getpid(), signal.SIGSTOP)"
    )
    with pytest.raises(SilentError, match="was stopped by a signal"):
        run(program(children), b"", 600.0, 100)
    deadline = time.monotonic() + 30.0
    child = Path(f"/proc/{(tmp_path / 'pid').read_text()}/stat")
    while child.exists() and b") Z" not in child.read_bytes() and time.monotonic() < deadline:
        os.sched_yield()
    assert not child.exists() or b") Z" in child.read_bytes()


def test_a_program_answers_what_it_is_told() -> None:
    answer = "import sys; print(sys.stdin.read().upper()); print('odd', file=sys.stderr); sys.exit(3)"
    finished = run(program(answer), b"hello", 60.0, 100)
    assert (finished.status, finished.output, finished.complaint) == (3, b"HELLO\n", "odd")


def test_time_is_counted_in_looks() -> None:
    waiting = patience(os.getpid(), 1.2)
    assert [next(waiting) for _ in range(3)] == pytest.approx([0.5, 0.5, 0.2])
    with pytest.raises(SilentError):
        next(waiting)
