"""A live face sent to another program: each frame when it is due, for as long as the face lasts."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Iterator
from types import TracebackType
from typing import Any

import numpy as np

from ...core.progress import Progress, quiet
from ...core.speech.audio import Samples
from ...errors import RisoriusError
from ..frame import LiveFrame
from ..session import Live
from .protocols import ArkitMoment, Options
from .receiver import PATIENCE, Receiver
from .receiver_socket import ReceiverSocket
from .send import SendCounts
from .sound import open_output


def send_live(
    face: Live,
    protocol: str,
    to: str = "127.0.0.1",
    *,
    listen: str | None = None,
    patience: float = PATIENCE,
    options: Options | None = None,
    sound: bool = False,
    progress: Progress = quiet,
) -> SendCounts:
    """Send a face, made with `arkit`, to another program until it is closed; return the frames sent.

    Arguments and errors are those of `send_take`; with `sound` the voice is played here and is the clock.
    Errors of a sentence are told to `progress`; the face goes on.
    """
    line = Receiver.named(protocol, to, listen, options).greeted(patience, progress)
    packets = line.protocol.make(face.fps, line.options)
    sent = 0
    with ReceiverSocket(line.address, tcp=line.protocol.tcp) as receiver, _Speaker(sound) as speaker:
        progress(f"Sending to {line.address} …")
        for frame in speaker.heard(_frames(face, paced=not sound, progress=progress)):
            for packet in packets(_moment(frame)):
                receiver.send(packet)
            sent += 1
    return SendCounts(sent, 0)


def _frames(face: Live, paced: bool, progress: Progress) -> Iterator[LiveFrame]:
    """Yield the frames of a face, whatever cannot be said."""
    while True:
        try:
            yield from face.frames(paced=paced, waits=False)
        except RisoriusError as error:
            progress(str(error))
        else:
            return


class _Speaker:
    """Plays the sound of frames, or nothing: `heard` yields each frame when its sound is heard."""

    def __init__(self, sounds: bool) -> None:
        self._sounds = sounds
        self._stream: Any = None
        self._rate = 0

    def heard(self, frames: Iterator[LiveFrame]) -> Iterator[LiveFrame]:
        """Yield frames. The device takes no more sound than it has room for, and so sets the pace."""
        if not self._sounds:
            yield from frames
            return
        waiting: deque[tuple[float, LiveFrame]] = deque()
        for frame in frames:
            self._play(frame.sound, frame.sample_rate)
            now = time.monotonic()
            waiting.append((now + float(self._stream.latency), frame))
            while waiting and waiting[0][0] <= now:
                yield waiting.popleft()[1]
        for due, frame in waiting:
            time.sleep(max(due - time.monotonic(), 0.0))
            yield frame

    def _play(self, samples: Samples, rate: int) -> None:
        if rate != self._rate:
            self._end()
            self._stream, self._rate = open_output(rate), rate
            self._stream.start()
        self._stream.write(samples[:, None])

    def _end(self) -> None:
        if self._stream is not None:
            self._stream.stop()
            self._stream.close()

    def __enter__(self) -> _Speaker:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._end()


def _moment(frame: LiveFrame) -> ArkitMoment:
    assert frame.arkit is not None
    assert frame.rotations is not None
    assert frame.emotion is not None
    turns = np.degrees(frame.rotations).reshape(3, 3)
    return ArkitMoment(frame.index, frame.arkit, turns[0], turns[1:], frame.shut, frame.emotion)
