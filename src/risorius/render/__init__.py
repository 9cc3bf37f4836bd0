"""The renderer: a software rasterizer that draws the head without GL."""

from .renderer import QUALITIES, Renderer

__all__ = ["QUALITIES", "Renderer"]
