"""The lamps: directions, colours and sizes of the light that falls on the head."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..errors import InputError
from .raster import FloatArray

Colour = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Lamp:
    """A far, soft lamp. Azimuth in degrees from the front towards the subject's left, elevation up.

    `colour` is the linear light it gives on a surface that faces it; `softness` widens its highlights (it is
    added to the roughness squared).
    """

    azimuth: float
    elevation: float
    colour: Colour
    softness: float = 0.05

    def direction(self) -> tuple[float, float, float]:
        """Return the unit vector from the head to the lamp."""
        a, e = math.radians(self.azimuth), math.radians(self.elevation)
        return math.sin(a) * math.cos(e), math.sin(e), math.cos(a) * math.cos(e)


@dataclass(frozen=True, slots=True)
class LightRig:
    """The lamps, the first of which casts shadows, and the light of the room from above and below."""

    lamps: tuple[Lamp, ...]
    sky: Colour
    ground: Colour

    def __post_init__(self) -> None:
        if not self.lamps:
            raise InputError("a light rig without lamps; expected at least one")

    def lighting(self) -> Lighting:
        """Return the rig as arrays for the kernels."""
        rows = [(*lamp.direction(), *lamp.colour, lamp.softness) for lamp in self.lamps]
        room = np.array([self.sky, self.ground], np.float32)
        return Lighting(np.array(rows, np.float32), room)


class Lighting(NamedTuple):
    """Lamps (n, 7) float32: direction, colour, softness; room (2, 3): from above, from below."""

    lamps: FloatArray
    room: FloatArray


STUDIO = LightRig(
    lamps=(
        Lamp(-34.0, 34.0, (2.75, 2.50, 2.22), 0.06),
        Lamp(46.0, 6.0, (0.70, 0.64, 0.62), 0.12),
        Lamp(140.0, 28.0, (1.35, 1.4, 1.5), 0.10),
        Lamp(-150.0, 26.0, (1.2, 1.15, 1.1), 0.10),
    ),
    sky=(0.52, 0.53, 0.56),
    ground=(0.30, 0.25, 0.22),
)
