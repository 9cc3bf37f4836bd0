"""The colours of a tongue: a paler back with a furrow along its middle, and redder edges and tip."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from .anatomy import smoothstep
from .srgb import linear

_FLESH, _COAT, _EDGE = (214, 122, 114), (226, 148, 138), (200, 96, 92)
_COATED = 0.6  # share of the coat's colour in the middle of the back
_FURROW, _FURROW_WIDTH = 0.35, 2.5  # share of light that the furrow takes, and its half width in mm


def tongue_colours(points: Array) -> Array:
    """Return the linear albedo (n, 3), 0..1, of a tongue at rest, `points` (n, 3) mm."""
    x, z = points[:, 0], points[:, 2]
    aside = np.abs(x) / np.abs(x).max()
    behind_tip = (z.max() - z) / (z.max() - z.min())
    inside = (1.0 - smoothstep(0.45, 0.95, aside)) * smoothstep(0.02, 0.22, behind_tip)
    coat = _COATED * inside
    colours = inside[:, None] * linear(_FLESH) + (1.0 - inside)[:, None] * linear(_EDGE)
    colours += coat[:, None] * (linear(_COAT) - colours)
    furrow = _FURROW * inside * np.exp(-((x / _FURROW_WIDTH) ** 2))
    return np.asarray(colours * (1.0 - furrow)[:, None])
