"""The program's side of the video worker: starts it, feeds it, and never waits for it for ever."""

from __future__ import annotations

import errno
import io
import json
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import cast

import numpy as np

from ...core import processes
from ...core.arrays import ByteArray, Int16Array
from ...errors import OutputError
from ...render.yuv import planes
from . import messages
from .codecs import CODECS
from .slots import Slots

# Seconds without progress after which the worker is given up.
PATIENCE = 60.0
_PIPE_BYTES = 1 << 20


class LostEncoderError(OutputError):
    """The worker died or did not answer: another one may do better."""


class VideoEncoder:
    """Writes one film through a worker process. Use as a context manager: leaving it completes the file.

    Pictures are handed over at once and encoded while the next one is made; at most a few wait. Raises
    LostEncoderError if the worker dies or does not answer for `patience` seconds, OutputError if it fails,
    and OSError for a fault of the disk.
    """

    def __init__(
        self,
        path: Path,
        size: tuple[int, int],
        fps: Fraction,
        sample_rate: int | None = None,
        patience: float = PATIENCE,
        *,
        codec: str = "mp4",
        channels: int = 3,
        draft: bool = False,
    ) -> None:
        self._shape = (size[1], size[0], channels)
        width, height = size[0] + size[0] % 2, size[1] + size[1] % 2
        pixels = "rgba" if channels == 4 else "rgb24"
        self._as_planes = channels == 3 and CODECS[codec].pixels == "yuv420p"
        if self._as_planes:
            pixels = "yuv420p"
        size_in_bytes = width * height * 3 // 2 if self._as_planes else width * height * channels
        self._slots, self._pictures, self._taken = Slots(messages.SLOTS, size_in_bytes), 0, 0
        self._patience = patience
        self._silence, self._begun = "", b""
        self._waits, self._is_waiting, self._over = 0, False, threading.Event()
        self._complaints = tempfile.TemporaryFile()  # noqa: SIM115 - closed by _stop()
        self._process = processes.start(
            "risorius.ports.video.worker",
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._complaints.fileno(),
            bufsize=0,
        )
        # Without buffering, pipes are raw files.
        self._input = cast(io.FileIO, self._process.stdin)
        self._answer = cast(io.FileIO, self._process.stdout)
        _widen(self._input.fileno())
        place, memory = str(path.absolute()), str(self._slots.path)
        self._setup = messages.Setup(
            place, width, height, str(fps), sample_rate, codec, pixels, memory, draft
        )

    @property
    def pid(self) -> int:
        """The worker's process id."""
        return self._process.pid

    def picture(self, rgb: ByteArray) -> None:
        """Add the next picture, uint8 of shape (height, width, channels); it may be changed afterwards."""
        if rgb.shape != self._shape or rgb.dtype != np.uint8:
            raise ValueError(f"a picture is {rgb.dtype}{rgb.shape}; expected uint8{self._shape}")
        self._wait_for_slot()
        number = self._pictures % messages.SLOTS
        slot, numbers = np.frombuffer(self._slots.slot(number), np.uint8), np.ascontiguousarray(_even(rgb))
        if self._as_planes:
            planes(numbers, slot)
        else:
            slot[:] = numbers.reshape(-1)
        self._pictures += 1
        self._send(messages.PICTURE, bytes([number]))

    def sound(self, samples: Int16Array) -> None:
        """Add int16 samples, shape (n,)."""
        if len(samples):
            self._send(messages.SOUND, samples.astype("<i2", copy=False).tobytes())

    def finish(self) -> None:
        """Complete the file and end the worker."""
        self._send(messages.END)
        answer = self._read_answer()
        if answer is None or "error" in answer:
            raise self._failure(answer)

    def _wait_for_slot(self) -> None:
        """Wait until the worker has copied the picture in the slot that is next."""
        while self._pictures - self._taken >= messages.SLOTS:
            with self._limit():
                answer = self._answer.read(1)
            if answer != messages.TAKEN:
                self._begun = answer
                raise self._failure(self._read_answer())
            self._taken += 1

    def _send(self, kind: bytes, payload: messages.Buffer = b"") -> None:
        try:
            with self._limit():
                messages.send(self._input, kind, payload)
        except OSError:
            raise self._failure(self._read_answer()) from None

    def _read_answer(self) -> dict[str, object] | None:
        """Wait for the worker's end and return its answer, None if it gave none."""
        with self._limit():
            text = (self._begun + self._answer.read()).lstrip(messages.TAKEN)
            self._process.wait()
        return json.loads(text) if text else None

    def _failure(self, answer: dict[str, object] | None) -> Exception:
        if self._silence:
            return LostEncoderError(f"the video encoder {self._silence}; it was ended")
        if answer is None:
            status = self._process.returncode
            return LostEncoderError(f"the video encoder died (exit status {status}){self._last_complaint()}")
        number = answer.get("errno")
        if isinstance(number, int) and number in errno.errorcode:
            return OSError(number, os.strerror(number))
        return OutputError(f"the video encoder failed: {answer.get('error')}")

    def _last_complaint(self) -> str:
        self._complaints.seek(0)
        lines = self._complaints.read().decode(errors="replace").split("\n")
        said = [line.strip() for line in lines if line.strip()]
        return f": {said[-1]}" if said else ""

    @contextmanager
    def _limit(self) -> Iterator[None]:
        """Let the worker be killed if the block takes too long, which ends any waiting for it."""
        self._waits += 1
        self._is_waiting = True
        try:
            yield
        finally:
            self._is_waiting = False

    def _watch(self) -> None:
        """Kill the worker if this process waits for it too long at a time.

        One thread looks at all waits: one for each would take longer than most of them.
        """
        try:
            while not self._over.wait(min(processes.LOOK, self._patience)):
                waits = self._waits
                for step in processes.patience(self.pid, self._patience):
                    if not self._is_waiting or self._waits != waits:
                        break
                    if self._over.wait(step):
                        return
        except processes.SilentError as error:
            self._silence = str(error)
            self._process.kill()

    def _stop(self) -> None:
        self._over.set()
        self._process.kill()
        self._process.wait()
        self._slots.close()
        for pipe in (self._input, self._answer, self._complaints):
            with suppress(OSError):
                pipe.close()

    def __enter__(self) -> VideoEncoder:
        threading.Thread(target=self._watch, daemon=True).start()
        try:
            self._send(messages.SETUP, self._setup.encode())
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                self.finish()
        finally:
            self._stop()


def _even(rgb: ByteArray) -> ByteArray:
    """Repeat the last row and column of an odd picture: most formats have even sides only."""
    height, width = rgb.shape[:2]
    if height % 2 == 0 and width % 2 == 0:
        return rgb
    return np.pad(rgb, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")


def _widen(descriptor: int) -> None:
    """Let the pipe hold a picture where the system can: fewer turns between the two processes."""
    if sys.platform == "linux":
        import fcntl

        with suppress(OSError):
            fcntl.fcntl(descriptor, fcntl.F_SETPIPE_SZ, _PIPE_BYTES)
