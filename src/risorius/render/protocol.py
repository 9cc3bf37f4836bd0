"""The interface of renderers, and the table of renderers by name.

A renderer is one file of the package `renderers` that registers a function by its name:

    @RENDERERS.register("mine")
    def open_mine(setup):
        return MyRenderer(...)

The function gets the model to draw from `looks.head_model.head_model`, with the looks from
`looks.apply_look.apply_look`, its camera from `framing.frame_head`, its lights from `lights.RIGS` and its
background from `backdrop.backdrop`. It does not draw the overlays: they are drawn on its pictures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from importlib import import_module
from pkgutil import iter_modules
from types import TracebackType
from typing import NamedTuple, Protocol, Self

from ..core.arrays import Array, ByteArray
from ..core.look import Size
from ..core.progress import Progress
from ..core.registry import Registry
from ..face.frame import FaceFrame
from ..face.head.head import Head
from ..settings import Look

DEFAULT = "software"


class PictureInput(NamedTuple):
    """The content of one picture.

    `suppression` (46,) is how much of each parameter its rivals suppress, 0 to 1 in the table's order; only
    the style "muscles" shows it. None counts as no suppression.
    """

    frame: FaceFrame
    suppression: Array | None = None


class Renderer(Protocol):
    """Draws one head at one size in one look, picture by picture.

    It is a context manager, which closes it. One thread uses it at a time.
    """

    @property
    def shape(self) -> tuple[int, int, int]:
        """Height and width of the pictures in pixels, and their channels: 3, or 4 if they have alpha."""

    def draw(self, inputs: Iterable[PictureInput]) -> Iterator[ByteArray]:
        """Yield the picture of each input in turn: uint8 of `shape`, sRGB, alpha not multiplied in.

        A picture is valid until the next one is asked for. Inputs are taken in the caller's thread, at most a
        few ahead of the pictures; the arrays of a frame may change as soon as the next input is taken. The
        same inputs give the same bytes, whatever came before. Raises InputError in the turn of a frame that
        does not fit the head, and whatever `inputs` raises; RuntimeError if the renderer is closed.
        """

    def close(self) -> None:
        """Release memory, threads and devices. Closing twice does nothing."""

    def __enter__(self) -> Self:
        """Return the renderer."""

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the renderer."""


@dataclass(frozen=True, slots=True)
class RendererSetup:
    """The set-up of a renderer: `head` at `size` (width, height) in pixels, with a `look`.

    `first_frame` solves a frame to warm up with. Its first call compiles the face for some seconds, so a
    renderer with long preparations of its own should begin them before. `progress` is told what takes long.
    """

    head: Head
    size: Size
    look: Look
    first_frame: Callable[[], FaceFrame]
    progress: Progress


OpenRenderer = Callable[[RendererSetup], Renderer]
"""Returns a renderer that is ready for its first picture.

Raises InputError for a size that cannot be drawn, and for a background that cannot be read.
"""

RENDERERS: Registry[OpenRenderer] = Registry("renderer")


def open_renderer(setup: RendererSetup, name: str = DEFAULT) -> Renderer:
    """Open the renderer called `name` (see `OpenRenderer`); raise ParameterError for an unknown name."""
    from . import renderers

    for module in iter_modules(renderers.__path__):
        import_module(f"{renderers.__name__}.{module.name}")
    return RENDERERS.get(name)(setup)
