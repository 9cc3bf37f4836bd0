"""Foreign programs: each has a limited time and output, and leaves no process behind."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from risorius.machine.programs import ProgramError, run


def program(text: str) -> list[str]:
    return [sys.executable, "-c", text]


def test_a_program_that_does_not_exist_is_an_error() -> None:
    with pytest.raises(OSError, match="No such file"):
        run(["/none"], b"", 10.0, 100)


@pytest.mark.parametrize(
    "text",
    [
        "import time; time.sleep(600)",
        "import os, time; os.close(1); time.sleep(600)",
        "import subprocess; subprocess.Popen(['sleep', '600'])",
    ],
)
def test_a_silent_program_is_given_up(text: str) -> None:
    with pytest.raises(ProgramError, match=r"gave no answer within 0\.7 s"):
        run(program(text), b"x" * 1_000_000, 0.7, 100)


def test_an_endless_answer_is_cut() -> None:
    with pytest.raises(ProgramError, match="more than 1 MB"):
        run(program("while True: print('x' * 100_000)"), b"", 60.0, 1_000_000)


@pytest.mark.skipif(sys.platform != "linux", reason="needs Linux")
def test_no_child_of_a_program_is_left(tmp_path: Path) -> None:
    children = (
        "import subprocess; p = subprocess.Popen(['sleep', '600'], stdout=subprocess.DEVNULL);"
        f"open({str(tmp_path / 'pid')!r}, 'w').write(str(p.pid))"
    )
    run(program(children), b"", 600.0, 100)
    child = Path(f"/proc/{(tmp_path / 'pid').read_text()}/stat")
    while child.exists() and b") Z" not in child.read_bytes():
        os.sched_yield()


def test_a_program_answers_what_it_is_told() -> None:
    answer = "import sys; print(sys.stdin.read().upper()); print('odd', file=sys.stderr); sys.exit(3)"
    finished = run(program(answer), b"hello", 60.0, 100)
    assert (finished.status, finished.output, finished.complaint) == (3, b"HELLO\n", "odd")
