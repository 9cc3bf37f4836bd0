"""The renderer on the CPU: a rasterizer that needs no graphics driver."""

from __future__ import annotations

from ..from_look import renderer_from_look
from ..protocol import DEFAULT, RENDERERS, Renderer, RendererSetup
from ..renderer_pool import RendererPool


@RENDERERS.register(DEFAULT)
def open_software(setup: RendererSetup) -> Renderer:
    """Return a pool of software renderers (see `OpenRenderer`)."""
    frame = setup.first_frame()
    renderer = renderer_from_look(setup.head, setup.size, setup.look)
    renderer.render(frame)
    return RendererPool(renderer)
