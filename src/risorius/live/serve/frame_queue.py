"""The queue of a client: a few frames, the sound of dropped frames, and events."""

from __future__ import annotations

import asyncio
from collections import deque

import numpy as np

from ...core.speech.audio import Samples
from ..frame import LiveFrame
from . import limits
from .frames import SentFrame


class FrameQueue:
    """Holds the latest `most` frames; of one that must go, the next has the sound."""

    def __init__(self, most: int = 1) -> None:
        self._most = most
        self._frames: deque[SentFrame] = deque()
        self._carried: SentFrame | None = None
        self._events: deque[str] = deque(maxlen=limits.EVENTS)
        self._ended = False
        self._filled = asyncio.Event()

    def put(self, frame: LiveFrame) -> None:
        """Put a frame in."""
        sent = SentFrame(frame, frame.sound, 0)
        self._frames.append(sent if self._carried is None else _after(self._carried, sent))
        self._carried = None
        if len(self._frames) > self._most:
            self._frames[1] = _after(self._frames[0], self._frames[1])
            self._frames.popleft()
        self._filled.set()

    def drop(self, frame: LiveFrame) -> None:
        """Keep the sound of a frame that is not sent."""
        sent = SentFrame(frame, frame.sound, 0)
        self._carried = sent if self._carried is None else _after(self._carried, sent)

    def tell(self, event: str) -> None:
        """Put an event in; events go before the frames that wait."""
        self._events.append(event)
        self._filled.set()

    def end(self) -> None:
        """End the queue after the items that wait."""
        self._ended = True
        self._filled.set()

    async def take(self) -> str | SentFrame | None:
        """Wait for an event or a frame, and take it; None at the end."""
        await self._filled.wait()
        item = self._events.popleft() if self._events else self._frames.popleft() if self._frames else None
        if not (self._events or self._frames or self._ended):
            self._filled.clear()
        return item


def _after(gone: SentFrame, sent: SentFrame) -> SentFrame:
    """Return a frame that follows one that is dropped, with the sound of both, as much as is kept."""
    sound: Samples = sent.sound
    if gone.frame.sample_rate == sent.frame.sample_rate:
        most = int(limits.KEPT_SOUND * sent.frame.sample_rate)
        sound = np.concatenate([gone.sound, sent.sound])[-most:]
    return SentFrame(sent.frame, sound, gone.dropped + 1 + sent.dropped)
