"""Pictures of a head: renderers behind one protocol, and overlays on their pictures."""

from .protocol import PictureInput, Renderer, RendererSetup, open_renderer

__all__ = ["PictureInput", "Renderer", "RendererSetup", "open_renderer"]
