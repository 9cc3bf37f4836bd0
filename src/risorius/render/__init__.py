"""The renderer: a software rasterizer that draws the head without GL."""

from .pictures import picture_renderer
from .renderer import Renderer

__all__ = ["Renderer", "picture_renderer"]
