"""Compiles what the renderer needs in a process of its own, while this one compiles the face.

A process compiles one function at a time, so that two share the wait of the first run between two processors.
Also a program, `python -m risorius.render.ahead STYLE`: it draws one small picture.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from subprocess import DEVNULL, TimeoutExpired

import numpy as np

from .. import compile_cache, workers
from ..core.look import Look
from ..core.parameters import NEUTRAL
from ..face.frame import FaceFrame
from ..face.head import Head, load_head
from ..face.regions import region_names
from .crew import processors
from .pictures import picture_renderer

_PATIENCE = 300.0
"""Seconds after which the other process is given up, and this one compiles for itself."""
_SIDE = 64


@contextmanager
def compiled_ahead(style: str) -> Iterator[None]:
    """Have the pictures of a style compiled during the block, if they are not yet and a processor is free.

    At the end of the block they are; where they could not be, they are compiled when they are needed.
    """
    if _mark(style).exists() or processors() < 2:
        yield
        return
    process = workers.start("risorius.render.ahead", style, stdin=DEVNULL, stdout=DEVNULL, stderr=DEVNULL)
    try:
        yield
        with suppress(TimeoutExpired):
            process.wait(_PATIENCE)
    finally:
        process.kill()
        process.wait()


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
    """Draw one picture in a style, and leave a mark beside the kernels that are now kept."""
    style = sys.argv[1]
    head = load_head("standard")
    picture_renderer(head, (_SIDE, _SIDE), Look(style=style)).render(_resting(head))
    _mark(style).touch()
    return 0


if __name__ == "__main__":
    sys.exit(main())
