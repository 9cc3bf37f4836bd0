"""The renderer: a software rasterizer that draws the head without GL."""

from .ahead import compiled_ahead
from .crew import Crew
from .pictures import picture_renderer
from .renderer import Renderer

__all__ = ["Crew", "Renderer", "compiled_ahead", "picture_renderer"]
