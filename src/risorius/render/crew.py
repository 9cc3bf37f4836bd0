"""Several renderers at work at once, each on a picture of its own."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from queue import SimpleQueue

from ..core.arrays import Array, ByteArray
from ..face.frame import FaceFrame
from .renderer import Renderer

MOST = 4
"""Pictures at once; faces are solved one after the other, and would not keep more renderers busy."""
_MEMORY = 400_000_000
"""Bytes that the renderers' buffers may take in all, unless one alone takes more."""

Job = tuple[FaceFrame, Array | None]


class Crew:
    """Draws a sequence of pictures by as many threads as the machine has processors, or `threads` of them.

    Each picture is drawn by one renderer from its frame alone, so that the bytes do not depend on how many
    there are.
    """

    def __init__(self, renderer: Renderer, threads: int | None = None) -> None:
        afforded = max(1, _MEMORY // renderer.buffer_bytes)
        self.threads = threads or min(processors(), MOST, afforded)
        self._first, self._count = renderer, 1
        self._idle: SimpleQueue[Renderer] = SimpleQueue()
        self._idle.put(renderer)

    def draw(self, jobs: Iterable[Job]) -> Iterator[ByteArray]:
        """Yield the picture of each job in turn: a frame, and how much rivals suppress each parameter.

        Jobs are asked for in the caller's thread, at most `threads` + 1 ahead of the pictures; a frame may
        change once the next is asked for. Raises what `jobs` and `Renderer.render` do.
        """
        at_work: deque[Future[ByteArray]] = deque()
        pool = ThreadPoolExecutor(self.threads, "picture")
        try:
            for frame, suppression in jobs:
                self._enlarge(len(at_work) + 1)
                at_work.append(pool.submit(self._draw, frame.copy(), suppression))
                if len(at_work) > self.threads:
                    yield at_work.popleft().result()
            while at_work:
                yield at_work.popleft().result()
        finally:
            pool.shutdown(wait=True, cancel_futures=True)

    def _enlarge(self, wanted: int) -> None:
        """Have as many renderers as are `wanted`, up to `threads`: one for a single picture.

        A twin may be made of one at work, since each picture writes anew all that is not shared.
        """
        while self._count < min(wanted, self.threads):
            self._idle.put(self._first.twin())
            self._count += 1

    def _draw(self, frame: FaceFrame, suppression: Array | None) -> ByteArray:
        renderer = self._idle.get()
        try:
            return renderer.render(frame, suppression=suppression)
        finally:
            self._idle.put(renderer)


def processors() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
