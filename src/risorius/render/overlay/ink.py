"""The subject, the font and the colours of all layers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

from ...core.performance import Performance
from ...core.speech.utterance import Utterance

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageFont import FreeTypeFont

InkColour = tuple[int, int, int, int]
"""Red, green, blue and opacity, 0 to 255 each."""
INK: InkColour = (245, 247, 249, 255)
SOFT: InkColour = (245, 247, 249, 150)
PANEL: InkColour = (14, 18, 24, 150)
BRIGHT: InkColour = (255, 196, 84, 255)
GROUND: InkColour = (18, 22, 28, 255)


@dataclass(frozen=True, slots=True)
class Subject:
    """The performance that the layers explain, and its utterance; None if nothing is said."""

    performance: Performance
    utterance: Utterance | None


class Layer(Protocol):
    """One kind of explanation; `below` is how many rows it needs under the picture."""

    below: int

    def draw(self, image: Image, height: int, frame: int) -> None:
        """Draw the explanation of a frame on an image whose picture is `height` rows high."""


@lru_cache(maxsize=32)
def font(size: int) -> FreeTypeFont:
    """Return the font that comes with Pillow, `size` pixels high."""
    from PIL import ImageFont
    from PIL.ImageFont import FreeTypeFont

    loaded = ImageFont.load_default(size=max(size, 6))
    if not isinstance(loaded, FreeTypeFont):
        raise RuntimeError("Pillow was built without FreeType")
    return loaded
