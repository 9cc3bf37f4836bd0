"""Hair that has gone grey with age: some hairs before others, those of the brows last."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..core.arrays import Array
from .srgb import linear
from .strands import Strands

_GREY = (160, 155, 147)  # sRGB: white hairs, and some that have kept a little of their colour
_BLENDED = 1.1  # range of the share over which a ribbon, which stands for several hairs, turns grey
_SPREAD = 0.41421356  # multiples of it, modulo 1, are spread evenly; `render/ribbons.py` has others


def greyed_colour(colour: Array, share: float) -> Array:
    """Return the linear colour (3,) of hair of which a share is grey, on average."""
    return np.asarray(colour + share * (linear(_GREY) - colour))


def greyed(hairs: Strands, share: float) -> Strands:
    """Return hairs of which a share, 0 to 1, is grey; light and dark locks stay lighter and darker."""
    if share == 0.0:
        return hairs
    turn = (np.arange(len(hairs.colours)) * _SPREAD) % 1.0
    amount = np.clip((share * (1.0 + _BLENDED) - turn) / _BLENDED, 0.0, 1.0)[:, None]
    light = hairs.colours.mean(axis=1, keepdims=True)
    grey = linear(_GREY) * np.clip(light / light.mean(), 0.6, 1.3)
    return replace(hairs, colours=(hairs.colours + amount * (grey - hairs.colours)).astype(np.float32))
