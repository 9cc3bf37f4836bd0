"""From the choices of a look to the renderer that draws it."""

from __future__ import annotations

from ..face.head import Head
from ..looks.anatomy import find_anatomy
from ..looks.apply_look import apply_look
from ..settings import Look
from .backdrop import backdrop
from .framing import frame_head
from .lights import RIGS
from .renderer import Renderer, check_size


def picture_renderer(head: Head, size: tuple[int, int], look: Look | None = None) -> Renderer:
    """Return the renderer of `head` at `size` (width, height) as `look` wants it.

    Raises InputError for a size that cannot be drawn, and for a background that cannot be read.
    """
    look = look or Look()
    width, height = check_size(size)
    rig = RIGS[look.light]
    return Renderer(
        head,
        (width, height),
        look.quality,
        camera=frame_head(find_anatomy(head), width / height, look.camera, look.lens),
        lights=rig,
        looks=apply_look(head.identity.looks, look),
        background=None
        if look.transparent
        else backdrop(width, height, look.background, rig.centre, rig.edge),
        alpha=look.transparent,
        style=look.style,
    )
