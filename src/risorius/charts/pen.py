"""A pen for smooth lines and sharp text: it draws twice as large as the picture that it gives."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from .sheet import ChartColour

if TYPE_CHECKING:
    from PIL.Image import Image
    from PIL.ImageFont import FreeTypeFont, ImageFont

TIMES = 2  # how much larger than the picture
PAPER: ChartColour = (255, 255, 255)
_DASH, _BREAK = 5.0, 4.0  # pixels

Spot = tuple[float, float]
"""x to the right and y downwards, in pixels of the picture."""


class Pen:
    """Draws on a white picture of `width` × `height` pixels."""

    def __init__(self, width: int, height: int) -> None:
        from PIL import Image
        from PIL.ImageDraw import Draw

        self._image = Image.new("RGB", (TIMES * width, TIMES * height), PAPER)
        self._draw = Draw(self._image, "RGBA")

    def picture(self) -> Image:
        """Return what was drawn."""
        from PIL import Image

        size = (self._image.width // TIMES, self._image.height // TIMES)
        return self._image.resize(size, Image.Resampling.LANCZOS)

    def line(
        self, points: Sequence[Spot], colour: ChartColour, width: float = 1.0, *, dashed: bool = False
    ) -> None:
        """Draw a line through points, as dashes if wanted."""
        scaled = np.asarray(points, np.float64) * TIMES
        for piece in _dashes(scaled) if dashed else [scaled]:
            if len(piece) > 1:
                path = [(float(x), float(y)) for x, y in piece]
                self._draw.line(path, fill=colour, width=max(round(TIMES * width), 1), joint="curve")

    def area(self, points: Sequence[Spot], colour: ChartColour, opacity: float) -> None:
        """Fill the area within points."""
        scaled = [(TIMES * x, TIMES * y) for x, y in points]
        self._draw.polygon(scaled, fill=(*colour, round(255 * opacity)))

    def box(self, corner: Spot, opposite: Spot, colour: ChartColour, opacity: float = 1.0) -> None:
        """Fill a rectangle."""
        (left, top), (right, bottom) = corner, opposite
        self.area([(left, top), (right, top), (right, bottom), (left, bottom)], colour, opacity)

    def text(
        self, spot: Spot, words: str, colour: ChartColour, size: int = 13, *, anchor: str = "lm"
    ) -> None:
        """Write words; `anchor` as Pillow has it: "lm" puts the middle of their left edge at the spot."""
        self._draw.text(
            (TIMES * spot[0], TIMES * spot[1]),
            words,
            fill=colour,
            font=_font(size),
            anchor=anchor,
        )

    def paste(self, picture: Image, corner: Spot) -> None:
        """Put a picture with its upper left corner at a spot."""
        larger = picture.resize((TIMES * picture.width, TIMES * picture.height))
        place = (round(TIMES * corner[0]), round(TIMES * corner[1]))
        self._image.paste(larger, place, larger if larger.mode == "RGBA" else None)


def width_of(words: str, size: int = 13) -> float:
    """Return how wide words are, in pixels of the picture."""
    return float(_font(size).getlength(words)) / TIMES


@cache
def _font(size: int) -> FreeTypeFont | ImageFont:
    from PIL import ImageFont

    return ImageFont.load_default(size=TIMES * size)


def _dashes(points: np.ndarray) -> list[np.ndarray]:
    """Return the dashes along a path (n, 2)."""
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    period = TIMES * (_DASH + _BREAK)
    pieces = []
    for start in np.arange(0.0, along[-1], period):
        end = min(start + TIMES * _DASH, along[-1])
        inner = along[(along > start) & (along < end)]
        at = np.concatenate(([start], inner, [end]))
        pieces.append(np.column_stack([np.interp(at, along, points[:, k]) for k in (0, 1)]))
    return pieces
