"""What stands behind the head: a soft gradient, in display light."""

from __future__ import annotations

import numpy as np

from .raster import FloatArray
from .tone import srgb_decode

Colour = tuple[int, int, int]
_CENTRE: Colour = (118, 126, 132)
_EDGE: Colour = (48, 54, 62)
_SEED = 3


def studio_backdrop(width: int, height: int, centre: Colour = _CENTRE, edge: Colour = _EDGE) -> FloatArray:
    """Return display light (height, width, 3) float32: brighter behind the head, darker to the corners.

    Half a step of fixed noise hides the bands that eight bits would show.
    """
    y, x = np.mgrid[0:height, 0:width]
    reach = 0.5 * max(width, height)
    distance = np.hypot((x - 0.5 * width) / (1.25 * reach), (y - 0.46 * height) / (1.25 * reach))
    share = np.exp(-1.5 * distance**2)[..., None]
    inner, outer = np.array(centre) / 255.0, np.array(edge) / 255.0
    encoded = outer + share * (inner - outer)
    noise = np.random.default_rng(_SEED).uniform(-0.5, 0.5, (height, width, 1)) / 255.0
    return srgb_decode(np.clip(encoded + noise, 0.0, 1.0)).astype(np.float32)
