"""The lamps: directions, colours and sizes of the light that falls on the head."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core.arrays import Float32Array
from ..core.look import LIGHTS, ByteColour
from ..errors import InputError
from .shading_block import LAMPS

LinearColour = tuple[float, float, float]
"""Linear light: red, green and blue, 1 on a white surface that faces a lamp of full strength."""


@dataclass(frozen=True, slots=True)
class Lamp:
    """A far, soft lamp. Azimuth in degrees from the front towards the subject's left, elevation up.

    `colour` is the linear light it gives on a surface that faces it; `softness` widens its highlights (it is
    added to the roughness squared).
    """

    azimuth: float
    elevation: float
    colour: LinearColour
    softness: float = 0.05

    def direction(self) -> tuple[float, float, float]:
        """Return the unit vector from the head to the lamp."""
        a, e = math.radians(self.azimuth), math.radians(self.elevation)
        return math.sin(a) * math.cos(e), math.sin(e), math.cos(a) * math.cos(e)


@dataclass(frozen=True, slots=True)
class LightRig:
    """The lamps, and the ambient light from above and below.

    The first lamp casts shadows that follow the face; the shadows of the others are computed once, for
    the head at rest. Eyes and mouth are lit by the first two, which should therefore stand in front. `centre`
    and `edge` are sRGB bytes of the backdrop's gradient; `pupil` is the radius of the pupils, in radii of the
    iris: wide in the dark.
    """

    lamps: tuple[Lamp, ...]
    sky: LinearColour
    ground: LinearColour
    centre: ByteColour = (118, 126, 132)
    edge: ByteColour = (48, 54, 62)
    pupil: float = 0.36

    def __post_init__(self) -> None:
        if not self.lamps:
            raise InputError("a light rig without lamps; expected at least one")
        if len(self.lamps) > LAMPS:
            raise InputError(f"a light rig of {len(self.lamps)} lamps; expected at most {LAMPS}")

    def lighting(self) -> Lighting:
        """Return the rig as arrays for the kernels."""
        rows = [(*lamp.direction(), *lamp.colour, lamp.softness) for lamp in self.lamps]
        ambient = np.array([self.sky, self.ground], np.float32)
        return Lighting(np.array(rows, np.float32), ambient, self.pupil)


class Lighting(NamedTuple):
    """A rig as arrays.

    `lamps` (n, 7) float32 are direction, colour and softness; `ambient` (2, 3) float32 the light from above
    and below; `pupil` the pupils' radius in radii of the iris.
    """

    lamps: Float32Array
    ambient: Float32Array
    pupil: float


STUDIO = LightRig(
    lamps=(
        Lamp(-34.0, 32.0, (2.75, 2.50, 2.22), 0.06),
        Lamp(42.0, 0.0, (0.85, 0.80, 0.79), 0.14),
        Lamp(140.0, 28.0, (1.9, 1.95, 2.1), 0.10),
        Lamp(-150.0, 26.0, (1.6, 1.52, 1.45), 0.10),
    ),
    sky=(0.54, 0.55, 0.58),
    ground=(0.40, 0.33, 0.29),
    centre=(118, 126, 132),
    edge=(48, 54, 62),
)
DAYLIGHT = LightRig(
    lamps=(
        Lamp(38.0, 46.0, (2.45, 2.28, 2.00), 0.10),
        Lamp(-40.0, 18.0, (0.72, 0.80, 0.92), 0.20),
        Lamp(-150.0, 40.0, (0.85, 0.95, 1.10), 0.16),
    ),
    sky=(0.86, 0.94, 1.06),
    ground=(0.46, 0.42, 0.34),
    centre=(214, 224, 232),
    edge=(150, 172, 192),
    pupil=0.30,
)
DARK = LightRig(
    lamps=(
        Lamp(-62.0, 28.0, (2.10, 1.62, 1.12), 0.05),
        Lamp(40.0, 4.0, (0.10, 0.13, 0.18), 0.16),
        Lamp(128.0, 22.0, (0.95, 1.35, 1.95), 0.08),
        Lamp(-140.0, 30.0, (0.55, 0.70, 0.95), 0.08),
    ),
    sky=(0.10, 0.12, 0.16),
    ground=(0.06, 0.05, 0.05),
    centre=(34, 38, 46),
    edge=(10, 11, 14),
    pupil=0.47,
)
RIGS = dict(zip(LIGHTS, (STUDIO, DAYLIGHT, DARK), strict=True))
"""The lights by their names."""
