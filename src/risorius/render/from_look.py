"""Make the software renderer for a head and a look."""

from __future__ import annotations

from ..core.look import Size
from ..face.head.head import Head
from ..looks.apply_look import apply_look
from ..looks.head_model import head_model
from ..settings import Look
from .backdrop import backdrop
from .framing import frame_head
from .lights import RIGS
from .software_renderer import SoftwareRenderer, check_size


def renderer_from_look(head: Head, size: Size, look: Look | None = None) -> SoftwareRenderer:
    """Return the renderer of `head` at `size` (width, height) in pixels as `look` wants it.

    Raises InputError for a size that cannot be drawn, and for a background that cannot be read.
    """
    look = look or Look()
    width, height = check_size(size)
    rig = RIGS[look.light]
    background = None
    if not look.transparent:
        background = backdrop(width, height, look.background, rig.centre, rig.edge)
    model = head_model(head, apply_look(head.identity.looks, look))
    return SoftwareRenderer(
        model,
        (width, height),
        look.quality,
        camera=frame_head(model.anatomy, width / height, look.camera, look.lens),
        lights=rig,
        background=background,
        alpha=look.transparent,
        style=look.style,
    )
