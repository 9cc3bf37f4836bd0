"""Overlays that explain a picture, on it or below it: one module and one line here for each kind."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from ...core.arrays import ByteArray
from ...core.look import OVERLAYS, Size
from .bars import Bars
from .caption import Caption
from .ink import Layer, Subject
from .lanes import Lanes
from .phones import Phones

_KINDS: dict[str, Callable[[Subject, Size], Layer]] = {
    "caption": Caption,
    "phones": Phones,
    "bars": Bars,
    "lanes": Lanes,
}


class Overlays:
    """Layers drawn over the pictures of one performance.

    `picture_size` (width, height) is the size of the picture itself, without the rows below it.
    """

    def __init__(self, names: Sequence[str], subject: Subject, size: Size) -> None:
        """Prepare the layers called `names` for whole pictures of `size` (width, height)."""
        self._size = size
        self._layers = [_KINDS[name](subject, size) for name in OVERLAYS if name in names]
        below = sum(layer.below for layer in self._layers)
        self.picture_size = (size[0], size[1] - below)

    def draw(self, picture: ByteArray, frame: int) -> ByteArray:
        """Return a picture of `picture_size` with the layers of that frame, at the whole size."""
        from PIL import Image

        if not self._layers:
            return picture
        width, height = self._size
        image = Image.new("RGBA" if picture.shape[2] == 4 else "RGB", (width, height))
        image.paste(Image.fromarray(picture))
        for layer in self._layers:
            layer.draw(image, self.picture_size[1], frame)
        return np.asarray(image)


__all__ = ["Overlays", "Subject"]
