"""Compiles what the renderer needs in a process of its own, while this one compiles the face.

A process compiles one function at a time, so that two share the wait of the first run between two processors.
Also a program, `python -m risorius.render.ahead STYLE`: it draws one small picture.
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
"""Seconds after which the other process is given up, and this one compiles for itself."""
_SIDE = 64


@contextmanager
def compiled_ahead(style: str, announce: Callable[[], object]) -> Iterator[Callable[[], None]]:
    """Have the pictures of a style compiled beside the block, unless they are: then say so by `announce`.

    Yields what to call in the block before one is drawn: it waits until they are compiled, where another
    process does; where none could, drawing does. A block that ends well leaves a mark that they are.
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
    """Run the process that compiles, if a processor is free for it; yield what waits for it."""
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
    """Wait for nothing."""


@contextmanager
def _no_collection() -> Iterator[None]:
    """Let garbage lie: a compiler makes millions of objects that live on, and looking through them takes a
    twentieth of its time.
    """
    collected = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if collected:
            gc.enable()


def _mark(style: str) -> Path:
    """Return the file that says that a style's kernels are kept: the realistic one has some of its own."""
    name = "realistic" if style == "realistic" else "explaining"
    return compile_cache.in_use() / f"{name}-{compile_cache.sources()}.compiled"


def _resting(head: Head) -> FaceFrame:
    """Return the face at rest, for which nothing need be solved."""
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
    """Draw one picture in a style, so that its kernels are kept."""
    head = load_head("standard")
    with _no_collection():
        renderer_from_look(head, (_SIDE, _SIDE), Look(style=sys.argv[1])).render(_resting(head))
    return 0


if __name__ == "__main__":
    sys.exit(main())
