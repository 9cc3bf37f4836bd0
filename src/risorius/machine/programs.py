"""Foreign programs: run once, for a limited time, with a limited output."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import IO

from .workers import last_line


class ProgramError(Exception):
    """A program takes too long, or prints too much; the message says which."""


@dataclass(frozen=True, slots=True)
class Finished:
    """A program that has ended: its exit status, its output, and the last line that it complained of."""

    status: int
    output: bytes
    complaint: str


def run(command: Sequence[str], data: bytes, seconds: float, largest: int) -> Finished:
    """Run a program with `data` on its input, and return what it prints.

    After that none of its processes is left. Raises OSError if it cannot be started, ProgramError if it takes
    longer than `seconds` or prints more than `largest` bytes.
    """
    with tempfile.TemporaryFile() as complaints:
        process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=complaints,
            start_new_session=True,
        )
        assert process.stdin is not None
        assert process.stdout is not None
        output = bytearray()
        feeder = threading.Thread(target=_feed, args=(process.stdin, data), daemon=True)
        reader = threading.Thread(target=_collect, args=(process.stdout, output, largest), daemon=True)
        try:
            feeder.start()
            reader.start()
            end = time.monotonic() + seconds
            reader.join(seconds)
            if len(output) > largest:
                raise ProgramError(f"printed more than {largest // 1_000_000} MB")
            with suppress(subprocess.TimeoutExpired):
                status = process.wait(max(0.0, end - time.monotonic()))
                if not reader.is_alive():
                    return Finished(status, bytes(output), last_line(complaints))
            raise ProgramError(f"gave no answer within {seconds:g} s")
        finally:
            _end(process)
            for thread in (feeder, reader):
                thread.join(timeout=1.0)


def _feed(pipe: IO[bytes], data: bytes) -> None:
    with suppress(OSError), pipe:
        pipe.write(data)


def _collect(pipe: IO[bytes], output: bytearray, largest: int) -> None:
    with suppress(OSError, ValueError), pipe:
        while len(output) <= largest and (piece := os.read(pipe.fileno(), 65_536)):
            output += piece


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a program and all that it has started; on Windows, which has no groups of them, the program."""
    if sys.platform != "win32":
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()
    process.wait()
