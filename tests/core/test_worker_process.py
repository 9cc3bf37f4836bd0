"""Worker processes: every way in which one can fail is noticed, and nothing waits for ever."""

from __future__ import annotations

import sys
import time

import pytest

from risorius.core.worker_process import WorkerError, WorkerProcess

ECHO = """
import json, sys
for line in sys.stdin:
    message = json.loads(line)
    data = message["text"].encode()
    header = json.dumps({"said": message["text"], "bytes": len(data)}).encode()
    sys.stdout.buffer.write(header + b"\\n" + data)
    sys.stdout.buffer.flush()
"""


def run(program: str) -> WorkerProcess:
    return WorkerProcess([sys.executable, "-c", program])


def test_a_program_that_does_not_exist() -> None:
    with pytest.raises(WorkerError, match="could not be started"):
        WorkerProcess(["/nowhere/risorius-worker"])


@pytest.mark.parametrize(
    ("program", "reason"),
    [
        ("", "ended without an answer"),
        ("import sys; sys.stdin.readline(); sys.exit('out of luck')", "exit code 1: out of luck"),
        ("import sys; sys.stdin.readline(); print('no JSON', flush=True)", "ended without an answer"),
        ("import sys; sys.stdin.readline(); print('[1]', flush=True)", "not a JSON object"),
        ("import sys; sys.stdin.readline(); print('{\"bytes\": 9}', flush=True)", "in the midst"),
    ],
)
def test_a_worker_that_fails_is_reported_with_the_reason(program: str, reason: str) -> None:
    with pytest.raises(WorkerError, match=reason):
        run(program).request({"text": "hello"}, timeout=10)


@pytest.mark.parametrize("reads", [True, False])
def test_a_silent_worker_is_given_up_and_killed(reads: bool) -> None:
    worker = run(f"import sys, time; {reads} and sys.stdin.readline(); time.sleep(600)")
    began = time.monotonic()
    # More than a pipe holds: writing must not block either.
    with pytest.raises(WorkerError, match="no answer within"):
        worker.request({"text": "x" * 1_000_000}, timeout=0.5)
    assert time.monotonic() - began < 5
    assert worker._process.returncode is not None


def test_answers_come_with_their_bytes_in_order() -> None:
    worker = run(ECHO)
    for text in ("one", "", "größer", "x" * 300_000):
        answer, data = worker.request({"text": text}, timeout=10)
        assert answer == {"said": text}
        assert data == text.encode()
    worker.close()
    assert worker._process.returncode == 0


def test_closing_twice_is_harmless() -> None:
    worker = run(ECHO)
    worker.close()
    worker.close()
