"""The time in a performance, by the sound that is heard or by the machine's clock."""

from __future__ import annotations

import time
from types import TracebackType
from typing import Protocol

from ...core.arrays import Int16Array
from ...core.speech.audio import Audio
from .sound import open_output


class Clock(Protocol):
    """Tells the seconds since the performance began, and waits."""

    def now(self) -> float:
        """Return seconds since the start."""

    def sleep(self, seconds: float) -> None:
        """Wait about so long."""

    def __enter__(self) -> Clock:
        """Start."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop."""


class MachineClock:
    """The machine's own clock, which never goes back."""

    def __init__(self) -> None:
        self._start = 0.0

    def now(self) -> float:
        """Return seconds since the start."""
        return time.perf_counter() - self._start

    def sleep(self, seconds: float) -> None:
        """Wait."""
        time.sleep(max(seconds, 0.0))

    def __enter__(self) -> MachineClock:
        self._start = time.perf_counter()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        pass


class SoundClock(MachineClock):
    """Plays a sound; its time is that of the samples heard, so that face and voice cannot drift apart.

    Between two blocks, and after the sound's end, the machine's clock goes on from there. Needs sounddevice
    (the extra `stream`); raises OutputError if it, or an output device, is missing.
    """

    def __init__(self, audio: Audio) -> None:
        super().__init__()
        self._audio = audio
        self._given = 0
        self._heard = (0.0, 0.0)  # seconds of sound, and when
        self._stream = open_output(audio.sample_rate, self._fill)

    def now(self) -> float:
        """Return the seconds of the sound that have been heard."""
        seconds, when = self._heard
        return seconds + (time.perf_counter() - when)

    def __enter__(self) -> SoundClock:
        self._heard = (-float(self._stream.latency), time.perf_counter())
        self._stream.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stream.stop()
        self._stream.close()

    def _fill(self, out: Int16Array, frames: int, timing: object, status: object) -> None:
        """Hand the next block to the device: it is heard after the device's latency."""
        block = self._audio.read(self._given, frames)
        out[: len(block), 0] = block
        out[len(block) :] = 0
        at = self._given / self._audio.sample_rate - float(self._stream.latency)
        self._heard = (at, time.perf_counter())
        self._given += frames
