"""A worker process driven over pipes: one JSON line and raw bytes per request, and the same per answer.

A request never waits longer than its timeout: the exchange happens on a thread, and a worker that is silent
for too long is killed.
"""

from __future__ import annotations

import contextlib
import json
import queue
import subprocess
import tempfile
import threading
from collections.abc import Sequence
from typing import IO, Any

from . import processes

Answer = tuple[dict[str, Any], bytes]


class WorkerError(Exception):
    """The worker ended, could not be started, or gave no answer in time; the message says which and why."""


class WorkerProcess:
    """One run of a worker program. After WorkerError it is gone, and a new one must be made."""

    def __init__(self, command: Sequence[str]) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as the process
        try:
            self._process = subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors
            )
        except OSError as error:
            self._errors.close()
            raise WorkerError(f"it could not be started: {error}") from error
        self._requests: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        self._answers: queue.SimpleQueue[Answer | WorkerError] = queue.SimpleQueue()
        self._thread = threading.Thread(target=self._exchange, daemon=True, name="risorius-worker")
        self._thread.start()

    @property
    def pid(self) -> int:
        """The process' number."""
        return self._process.pid

    def request(self, message: dict[str, Any], timeout: float, data: bytes = b"") -> Answer:
        """Send `message` and its bytes, and return the answer and its own.

        The worker reads from `bytes` in the message how many there are. Raises WorkerError if it fails, and
        after `timeout` seconds.
        """
        header = message | {"bytes": len(data)} if data else message
        self._requests.put(json.dumps(header).encode() + b"\n" + data)
        try:
            answer = self._answer(timeout)
        except processes.SilentError as error:
            self.kill()
            raise WorkerError(f"it {error}") from None
        except BaseException:
            # Interrupted: a late answer must never be taken for that of the next request.
            self.kill()
            raise
        if isinstance(answer, WorkerError):
            reason = self._reason()
            self.kill()
            raise WorkerError(f"{answer}{reason}")
        return answer

    def _answer(self, timeout: float) -> Answer | WorkerError:
        for step in processes.patience(self.pid, timeout):
            with contextlib.suppress(queue.Empty):
                return self._answers.get(timeout=step)
        raise AssertionError("patience ends with an error")

    def close(self) -> None:
        """End the worker by ending its input; kill it if it does not go."""
        self._requests.put(None)
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(timeout=1.0)
        self.kill()

    def kill(self) -> None:
        """End the worker at once and release everything."""
        self._process.kill()
        self._process.wait()
        self._requests.put(None)
        self._thread.join(timeout=1.0)
        self._errors.close()

    def _exchange(self) -> None:
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None
        with contextlib.suppress(OSError), stdin, stdout:
            while (request := self._requests.get()) is not None:
                try:
                    stdin.write(request)
                    stdin.flush()
                    self._answers.put(_read_answer(stdout))
                except (OSError, ValueError) as error:
                    self._answers.put(WorkerError(f"it ended without an answer ({error or 'broken pipe'})"))
                    return

    def _reason(self) -> str:
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(timeout=1.0)
        self._errors.seek(0)
        lines = self._errors.read().decode("utf-8", "replace").strip().splitlines()
        code = self._process.returncode
        return (f", exit code {code}" if code is not None else "") + (f": {lines[-1]}" if lines else "")


def _read_answer(stream: IO[bytes]) -> Answer:
    line = stream.readline()
    if not line.endswith(b"\n"):
        raise ValueError("end of its output")
    header = json.loads(line)
    if not isinstance(header, dict):
        raise ValueError("an answer that is not a JSON object")
    size = int(header.pop("bytes", 0))
    data = stream.read(size)
    if len(data) < size:
        raise ValueError("end of its output in the midst of an answer")
    return header, data
