"""The renderer on the CPU: a rasterizer that needs no graphics driver, compiled by numba."""

from __future__ import annotations

from collections.abc import Callable

from ...core.look import Size
from ...face.frame import FaceFrame
from ...face.head import Head
from ...settings import Look
from ..ahead import compiled_ahead
from ..from_look import renderer_from_look
from ..protocol import DEFAULT, RENDERERS, Renderer
from ..renderer_pool import RendererPool

COMPILING = "Compiling the face and the renderer (once, about 25 s) …"


@RENDERERS.register(DEFAULT)
def open_software(
    head: Head,
    size: Size,
    look: Look,
    first_frame: Callable[[], FaceFrame],
    progress: Callable[[str], object],
) -> Renderer:
    """Return a pool of software renderers (see `OpenRenderer`)."""
    with compiled_ahead(look.style, lambda: progress(COMPILING)) as wait:
        frame = first_frame()
        wait()
        renderer = renderer_from_look(head, size, look)
        renderer.render(frame)
    return RendererPool(renderer)
