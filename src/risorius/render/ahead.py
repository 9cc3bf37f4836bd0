"""Announce and count the kernels that the first picture waits for, and compile them in two processes.

Where the code that comes with the package fits, machine code is made of it sooner than a second process
starts. Else the second one compiles the renderer while this one compiles the face, since a process compiles
one function at a time. It is also a program, `python -m risorius.render.ahead STYLE`: it draws one small
picture.
"""

from __future__ import annotations

import gc
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import DEVNULL, TimeoutExpired
from typing import Any

import numpy as np
from numba.core import event

from ..core import processes
from ..core.kernels import compile_cache, shipped
from ..core.parameters import NEUTRAL
from ..core.progress import Progress
from ..face.frame import FaceFrame
from ..face.head import Head, load_head
from ..face.regions import region_names
from ..settings import Look
from .from_look import renderer_from_look

_PATIENCE = 300.0
"""Seconds to wait for the other process; after that, this process compiles for itself."""
_SIDE = 64
ANNOUNCED = "Compiling the face and the renderer (once, about {} s) …"
SECONDS = {True: 5, False: 15}
"""How long the first picture takes by the clock: from the package's code, and where all is compiled."""
_STAGE = "Compiling"
_PAUSE = 0.1  # s between two looks at what is in the cache, each of which takes a millisecond
_LOOK = 0.5  # s between two looks at what the other process has compiled


@contextmanager
def compiled_ahead(style: str, progress: Progress) -> Iterator[Callable[[], None]]:
    """Compile the kernels of a style in another process while the block runs.

    Yields a function for the block to call before it draws: it waits for that process. If no processor is
    free for one, it returns at once, and drawing compiles the kernels. `progress` is told if the kernels
    are not compiled yet, and how many of them are. A block that ends without an error leaves a mark that
    they are.
    """
    if _mark(style).exists():
        yield _no_wait
        return
    ready = shipped.covers(_kind(style))
    progress(ANNOUNCED.format(SECONDS[ready]))
    counted = _Counted(progress, shipped.needed(_kind(style)))
    with (
        _no_collection(),
        event.install_listener(shipped.STORED, counted),
        _compiler(style, counted.tell, ready) as wait,
    ):
        yield wait
    counted.finish()
    with suppress(OSError):
        _mark(style).touch()


class _Counted(event.Listener):  # type: ignore[misc]  # numba has no types
    """Tells how many kernels are in the cache, whichever process stored them, when that has changed."""

    def __init__(self, progress: Progress, total: int) -> None:
        self._progress, self._total, self._told, self._looked = progress, total, 0, -np.inf
        self._folder = compile_cache.in_use()
        self._before = self._stored()

    def on_start(self, event: Any) -> None:
        """Do nothing: the last kernel is told of already."""

    def on_end(self, event: Any) -> None:
        """Tell after each kernel that this process stores."""
        self.tell()

    def tell(self) -> None:
        """Tell how many kernels there are, if there are more than were told of; look not too often."""
        now = time.monotonic()
        if now - self._looked < _PAUSE:
            return
        self._looked = now
        done = min(self._stored() - self._before, self._total - 1)
        if done > self._told:
            self._told = done
            self._progress(_STAGE, done, self._total)

    def finish(self) -> None:
        """Tell that all are done, if it is known how many they are."""
        if self._total:
            self._progress(_STAGE, self._total, self._total)

    def _stored(self) -> int:
        return sum(1 for _ in self._folder.rglob("*.nbi"))


@contextmanager
def _compiler(style: str, tell: Callable[[], None], ready: bool) -> Iterator[Callable[[], None]]:
    """Start the process that compiles if a processor is free for it; yield a function that waits for it.

    None is started if the package's code is `ready` for all kernels.
    """
    if ready or processes.processors() < 2:
        yield _no_wait
        return
    process = processes.start("risorius.render.ahead", style, stdin=DEVNULL, stdout=DEVNULL, stderr=DEVNULL)

    def wait() -> None:
        end = time.monotonic() + _PATIENCE
        while time.monotonic() < end:
            with suppress(TimeoutExpired):
                process.wait(_LOOK)
                return
            tell()

    try:
        yield wait
    finally:
        process.kill()
        process.wait()


def _no_wait() -> None:
    """Return at once: there is no process to wait for."""


@contextmanager
def _no_collection() -> Iterator[None]:
    """Disable garbage collection while compiling: it would scan millions of live objects.

    That takes a twentieth of the time of compiling.
    """
    collected = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collected:
            gc.enable()


def _mark(style: str) -> Path:
    """Return the file that marks a style's kernels as compiled."""
    return compile_cache.in_use() / f"{_kind(style)}-{compile_cache.sources()}.compiled"


def _kind(style: str) -> str:
    """Return what a style's kernels are called; the styles of diagrams share theirs."""
    return "realistic" if style == "realistic" else "explaining"


def _resting(head: Head) -> FaceFrame:
    """Return the face at rest, without a solver."""
    skin = np.asarray(head.skin.matrix @ head.rest, np.float32)
    return FaceFrame(
        skin=skin,
        teeth_lower=np.array(head.teeth_lower.vertices, np.float32),
        tongue=np.asarray(head.tongue.subdivision.matrix @ head.tongue.rest, np.float32),
        eye_rotation=np.stack([np.eye(3), np.eye(3)]),
        head_rotation=np.eye(3),
        jaw_angle=0.0,
        wrinkles=np.zeros((len(skin), len(region_names())), np.float32),
        parameters=np.array(NEUTRAL, np.float64),
    )


def main() -> int:
    """Draw one picture in a style, which compiles its kernels and stores them on disk."""
    head = load_head("standard")
    with _no_collection():
        renderer_from_look(head, (_SIDE, _SIDE), Look(style=sys.argv[1])).render(_resting(head))
    return 0


if __name__ == "__main__":
    sys.exit(main())
