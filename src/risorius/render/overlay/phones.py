"""The phones: a strip that moves with the sound, with the current phone in the middle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...core.look import Size
from .ink import BRIGHT, INK, PANEL, SOFT, Subject, font

if TYPE_CHECKING:
    from PIL.Image import Image

_SPAN = 1.2  # seconds shown


class Phones:
    """A strip at the top of the picture."""

    below = 0

    def __init__(self, subject: Subject, size: Size) -> None:
        self._times = subject.performance.times
        self._text = font(round(0.030 * min(size)))
        phones = subject.utterance.phones if subject.utterance else ()
        self._phones = [p for p in phones if p.symbol]

    def draw(self, image: Image, height: int, frame: int) -> None:
        """Draw the phones about the time of a frame."""
        from PIL import ImageDraw

        time = float(self._times[frame])
        pen, high = ImageDraw.Draw(image, "RGBA"), self._text.size
        middle, scale, top = 0.5 * image.width, 0.5 * image.width / _SPAN, 0.7 * high
        left, right = middle - 0.5 * _SPAN * scale, middle + 0.5 * _SPAN * scale
        pen.rounded_rectangle((left, top, right, top + 1.8 * high), radius=0.4 * high, fill=PANEL)
        free = -1.0  # where the last label ends
        for phone in self._phones:
            x = max(left, middle + (phone.start - time) * scale)
            end = min(right, middle + (phone.end - time) * scale)
            if end <= x:
                continue
            now = phone.start <= time < phone.end
            pen.line((x, top + 0.35 * high, x, top + 1.45 * high), fill=SOFT)
            wide, centre = self._text.getlength(phone.symbol), 0.5 * (x + end)
            # The current phone is always named, those beside it if they stand within their own room.
            if now or (wide < end - x and centre - 0.5 * wide > free):
                ink = BRIGHT if now else INK
                place = (centre, top + 0.9 * high)
                pen.text(place, phone.symbol, font=self._text, fill=ink, anchor="mm")
                free = centre + 0.5 * wide
        pen.line((middle, top, middle, top + 1.8 * high), fill=BRIGHT, width=2)
