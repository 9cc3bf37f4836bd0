"""The renderer on the CPU: a rasterizer that needs no graphics driver, compiled by numba."""

from __future__ import annotations

from ..ahead import compiled_ahead
from ..from_look import renderer_from_look
from ..protocol import DEFAULT, RENDERERS, Renderer, RendererSetup
from ..renderer_pool import RendererPool


@RENDERERS.register(DEFAULT)
def open_software(setup: RendererSetup) -> Renderer:
    """Return a pool of software renderers (see `OpenRenderer`)."""
    with compiled_ahead(setup.look.style, setup.progress) as wait:
        frame = setup.first_frame()
        wait()
        renderer = renderer_from_look(setup.head, setup.size, setup.look)
        renderer.render(frame)
    return RendererPool(renderer)
