"""Compile the software renderer in a second process while this one compiles the face.

A process compiles one function at a time, so two processes on two processors shorten the first run. This is
also a program, `python -m risorius.render.ahead STYLE`: it draws one small picture.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import DEVNULL, TimeoutExpired

import numpy as np

from ..core import processes
from ..core.kernels import compile_cache
from ..core.parameters import NEUTRAL
from ..face.frame import FaceFrame
from ..face.head import Head, load_head
from ..face.regions import region_names
from ..settings import Look
from .from_look import renderer_from_look
from .renderer_pool import processors

_PATIENCE = 300.0
"""Seconds to wait for the other process; after that, this process compiles for itself."""
_SIDE = 64


@contextmanager
def compiled_ahead(style: str, announce: Callable[[], object]) -> Iterator[Callable[[], None]]:
    """Compile the kernels of a style in another process while the block runs.

    Yields a function for the block to call before it draws: it waits for that process. If no processor is
    free for one, it returns at once, and drawing compiles the kernels. `announce` is called if the kernels
    are not compiled yet. A block that ends without an error leaves a mark that they are.
    """
    if _mark(style).exists():
        yield _no_wait
        return
    announce()
    with _no_collection(), _compiler(style) as wait:
        yield wait
    with suppress(OSError):
        _mark(style).touch()


@contextmanager
def _compiler(style: str) -> Iterator[Callable[[], None]]:
    """Start the process that compiles if a processor is free for it; yield a function that waits for it."""
    if processors() < 2:
        yield _no_wait
        return
    process = processes.start("risorius.render.ahead", style, stdin=DEVNULL, stdout=DEVNULL, stderr=DEVNULL)

    def wait() -> None:
        with suppress(TimeoutExpired):
            process.wait(_PATIENCE)

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
    """Return the file that marks a style's kernels as compiled; the styles of diagrams share one."""
    name = "realistic" if style == "realistic" else "explaining"
    return compile_cache.in_use() / f"{name}-{compile_cache.sources()}.compiled"


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
