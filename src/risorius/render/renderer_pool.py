"""A pool of software renderers, which draw several pictures at once, each in a thread of its own."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from queue import SimpleQueue
from types import TracebackType
from typing import Self

from ..core.arrays import ByteArray
from ..machine.processes import processors
from .protocol import PictureInput
from .software_renderer import SoftwareRenderer

MOST = 4
"""Pictures at once; faces are solved one after the other, and would not keep more renderers busy."""
_MEMORY = 400_000_000
"""Bytes that the renderers' buffers may take in all, unless one alone takes more."""


class RendererPool:
    """The protocol `Renderer` by as many threads as the machine has processors, or by `threads` of them.

    Each picture is drawn by one renderer from its input alone, so that the bytes do not depend on how many
    there are.
    """

    def __init__(self, renderer: SoftwareRenderer, threads: int | None = None) -> None:
        affordable = max(1, _MEMORY // renderer.buffer_bytes)
        self.threads = threads or min(processors(), MOST, affordable)
        self.shape = renderer.shape
        self._first: SoftwareRenderer | None = renderer
        self._count = 1
        self._idle: SimpleQueue[SoftwareRenderer] = SimpleQueue()
        self._idle.put(renderer)

    def draw(self, inputs: Iterable[PictureInput]) -> Iterator[ByteArray]:
        """Yield the picture of each input in turn; inputs are taken at most 2 `threads` + 1 ahead.

        Twice as many are at work as are drawn at once: a picture that takes long keeps no thread waiting.
        """
        at_work: deque[Future[ByteArray]] = deque()
        idle = self._idle  # still here for the threads if the pool is closed meanwhile
        pool = ThreadPoolExecutor(self.threads, "picture")
        try:
            for frame, suppression in inputs:
                self._enlarge(len(at_work) + 1)
                at_work.append(pool.submit(_draw, idle, PictureInput(frame.copy(), suppression)))
                while at_work and (at_work[0].done() or len(at_work) > 2 * self.threads):
                    yield at_work.popleft().result()
            while at_work:
                yield at_work.popleft().result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)

    def close(self) -> None:
        """Let go of all renderers and their buffers."""
        self._first, self._idle = None, SimpleQueue()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _enlarge(self, count: int) -> None:
        """Open up to `count` renderers, at most `threads`: one for a single picture.

        A clone may be made of one at work, since each picture writes anew all that is not shared.
        """
        if self._first is None:
            raise RuntimeError("the renderer is closed")
        while self._count < min(count, self.threads):
            self._idle.put(self._first.clone())
            self._count += 1


def _draw(idle: SimpleQueue[SoftwareRenderer], picture: PictureInput) -> ByteArray:
    renderer = idle.get()
    try:
        return renderer.render(picture.frame, suppression=picture.suppression)
    finally:
        idle.put(renderer)
