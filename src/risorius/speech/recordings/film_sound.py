"""The sound of films and of telephones' recordings: m4a, mp4, mov, webm, aac, by a worker process."""

from __future__ import annotations

import json
import os
import subprocess
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, cast

import numpy as np

from ...core import processes
from ...core.arrays import Float32Array
from ...errors import InputError, Place

PATIENCE = 60.0  # seconds without a sound after which the decoder is given up
_LONGEST_LINE = 10_000
_BOXES = (b"ftyp", b"moov", b"mdat", b"wide", b"free", b"skip", b"pnot")
_MATROSKA = b"\x1a\x45\xdf\xa3"
_ADTS = (b"\xff\xf0", b"\xff\xf1", b"\xff\xf8", b"\xff\xf9")


def container_of(beginning: bytes) -> str | None:
    """Return the container that a file of these first bytes is, as the decoder names it; None for no film."""
    if beginning[4:8] in _BOXES:
        return "mov"
    if beginning.startswith(_MATROSKA):
        return "matroska"
    return "aac" if beginning.startswith(_ADTS) else None


class FilmSound:
    """The sound of a film, its channels averaged. Use as a context manager: leaving it ends the decoder.

    `sample_rate` is known from the start. Raises InputError with the file's place if it has no sound, if it
    cannot be decoded, or if the decoder does not answer for `PATIENCE` seconds.
    """

    def __init__(self, path: Path, container: str, place: Place) -> None:
        self._place, self._decoded = place, 0
        self._complaint, self._waiting = "", False
        self._process = processes.start(
            "risorius.speech.recordings.film_worker",
            os.fspath(path.absolute()),
            container,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self._heard = threading.Event()
        threading.Thread(target=self._watch, daemon=True).start()
        try:
            self.sample_rate = int(self._message().get("rate", 0))
        except BaseException:
            self.close()
            raise

    def blocks(self) -> Iterator[Float32Array]:
        """Yield the samples, each block of shape (n,), in order."""
        while size := self._message().get("bytes", 0):
            data = self._read(int(size))
            self._decoded += len(data) // 4
            yield np.frombuffer(data, "<f4").astype(np.float32, copy=False)

    def _message(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        self._waiting = True
        line = self._process.stdout.readline(_LONGEST_LINE)
        self._waiting = False
        self._heard.set()
        message = cast("dict[str, Any]", json.loads(line)) if line.endswith(b"\n") else {"error": self._end()}
        if "error" in message:
            raise self._fault(message)
        return message

    def _read(self, size: int) -> bytes:
        assert self._process.stdout is not None
        data = self._process.stdout.read(size)
        if len(data) < size:
            raise self._fault({"error": self._end()})
        return data

    def _end(self) -> str:
        """Say how a decoder ended that did not answer."""
        status = self._process.wait()
        return self._complaint or f"the decoder died, exit status {status}"

    def _fault(self, message: dict[str, Any]) -> InputError:
        reason = str(message["error"])
        if message.get("silent"):
            return InputError(f"{reason}; expected a recording, or a film with a voice", self._place)
        if not self._decoded:
            return InputError(f"cannot be read ({reason}); expected a recording", self._place)
        at = self._decoded / self.sample_rate
        return InputError(f"cannot be decoded from {at:.2f} s on: {reason}", self._place)

    def _watch(self) -> None:
        """End a decoder that says nothing for too long while it is waited for, which ends the waiting."""
        while self._process.poll() is None:
            try:
                for step in processes.patience(self._process.pid, PATIENCE):
                    if self._heard.wait(step) or not self._waiting or self._process.poll() is not None:
                        break
                self._heard.clear()
            except processes.SilentError as error:
                self._complaint = f"the decoder {error}"
                self._process.kill()

    def close(self) -> None:
        """End the decoder."""
        self._process.kill()
        self._process.wait()
        self._heard.set()
        if self._process.stdout is not None:
            with suppress(OSError):
                self._process.stdout.close()

    def __enter__(self) -> FilmSound:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
