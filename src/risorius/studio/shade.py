"""The light that the page draws a head in: the library's own, and what the head at rest keeps from itself."""

from __future__ import annotations

import numpy as np

from ..face.head import Head
from ..render.inputs import EXTRA, OCCLUSION
from ..render.lights import STUDIO
from ..render.scene import HeadScene
from .tables import Lamp, Light

HEM_STEPS = 4.0


def light() -> Light:
    """Return the lamps (direction and linear colour each), and the room's light from above and below."""
    lamps = tuple(Lamp(lamp.direction(), lamp.colour) for lamp in STUDIO.lamps)
    return Light(lamps, STUDIO.sky, STUDIO.ground)


def shade(head: Head) -> bytes:
    """Return what each vertex of the skin sees at rest of the room and of each lamp, and where cloth is worn.

    uint8 (vertices, 1 + lamps + 1): 255 for all of the light; the last is 128 at the neckline, one more
    for each 1 / HEM_STEPS mm into the cloth. The first of a scene's lamps is left to shadows that move, so
    the page's are all put behind it.
    """
    lamps = STUDIO.lighting().lamps
    scene = HeadScene(head, np.concatenate([lamps[:1], lamps]))
    count = head.skin.matrix.shape[0]
    under_hair = scene.reach[:count, :1]
    reach = scene.reach[:count, 1:] * np.concatenate([under_hair, np.ones((count, len(lamps) - 1))], axis=1)
    seen = np.concatenate([scene.attributes[:count, OCCLUSION, None], reach], axis=1)
    hem = 128.0 + HEM_STEPS * scene.attributes[:count, EXTRA, None]
    found = np.concatenate([255.0 * seen.clip(0.0, 1.0), hem.clip(0.0, 255.0)], axis=1)
    return np.round(found).astype(np.uint8).tobytes()
