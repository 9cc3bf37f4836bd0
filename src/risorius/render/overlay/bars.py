"""Action units as bars beside the face."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...core.action_units import ACTION_UNITS, ActionUnit
from ...core.arrays import Array
from ...core.look import Size
from ...core.parameters import BASES, INDEX
from ...core.performance import Performance
from .ink import BRIGHT, INK, PANEL, SOFT, Subject, font

if TYPE_CHECKING:
    from PIL.Image import Image

UNITS = (1, 2, 4, 5, 6, 9, 10, 12, 15, 17, 20, 22, 24, 26, 43)


class Bars:
    """A panel on the left of the picture with one bar for each unit."""

    below = 0

    def __init__(self, subject: Subject, size: Size) -> None:
        self._units = [ACTION_UNITS[number] for number in UNITS]
        self._values = unit_values(subject.performance, self._units)
        self._text = font(round(0.0235 * min(size)))

    def draw(self, image: Image, height: int, frame: int) -> None:
        """Draw the units' intensities at a frame."""
        from PIL import ImageDraw

        pen, high = ImageDraw.Draw(image, "RGBA"), self._text.size
        row, wide = 1.55 * high, 4.2 * high
        left, label = 0.6 * high, 3.0 * high
        top = max(0.5 * (height - row * len(self._units)), 0.6 * high)
        box = (left, top - 0.4 * high, left + label + wide + 1.2 * high, top + row * len(self._units))
        pen.rounded_rectangle(box, radius=0.4 * high, fill=PANEL)
        for k, unit in enumerate(self._units):
            y, x = top + k * row, left + label + 0.6 * high
            value = float(self._values[frame, k])
            pen.text((left + 0.5 * high, y), f"AU{unit.number}", font=self._text, fill=INK)
            pen.rectangle((x, y + 0.25 * high, x + wide, y + 0.95 * high), outline=SOFT)
            if value > 0.01:
                pen.rectangle((x, y + 0.25 * high, x + value * wide, y + 0.95 * high), fill=BRIGHT)


def unit_values(performance: Performance, units: list[ActionUnit]) -> Array:
    """Return intensities 0..1 of action units, (frames, units): the mean of the muscles that perform each."""
    columns = []
    for unit in units:
        shares = [
            performance.values[:, INDEX[p.name]] / weight
            for base, weight in unit.weights.items()
            for p in BASES[base]
        ]
        columns.append(np.clip(np.mean(shares, axis=0), 0.0, 1.0))
    return np.stack(columns, axis=1)
