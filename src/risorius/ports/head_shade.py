"""The light that the page draws a head in: the library's own, and what the head at rest keeps from itself."""

from __future__ import annotations

import numpy as np

from ..face.head import Head
from ..looks.anatomy import find_anatomy
from ..looks.garment import neckline
from ..render.lights import STUDIO
from ..render.resting import light_at_rest
from .stage_table import StageLamp, StageLight

HEM_STEPS = 4.0


def light() -> StageLight:
    """Return the lamps (direction and linear colour each), and the ambient light from above and below."""
    lamps = tuple(StageLamp(lamp.direction(), lamp.colour) for lamp in STUDIO.lamps)
    return StageLight(lamps, STUDIO.sky, STUDIO.ground)


def shade(head: Head) -> bytes:
    """Return what each vertex of the skin sees at rest of its surroundings and of each lamp, and the cloth.

    uint8 (vertices, 1 + lamps + 1): 255 for all of the light; the last is 128 at the neckline, one more
    for each 1 / HEM_STEPS mm into the cloth that is worn.
    """
    shares = light_at_rest(head, STUDIO)
    hem = 128.0 + HEM_STEPS * neckline(find_anatomy(head)).astype(np.float32)[:, None]
    columns = np.concatenate([255.0 * shares.clip(0.0, 1.0), hem.clip(0.0, 255.0)], axis=1)
    return np.round(columns).astype(np.uint8).tobytes()
