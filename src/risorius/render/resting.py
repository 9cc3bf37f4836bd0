"""The light that a head at rest lets through to its own skin, for programs that draw it themselves."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Float32Array
from ..face.head import Head
from ..looks.attributes import OCCLUSION
from ..looks.head_model import head_model
from .lights import LightRig
from .scene import HeadScene


def light_at_rest(head: Head, rig: LightRig) -> Float32Array:
    """Return what each of the skin's N1 vertices sees at rest: shares (N1, 1 + lamps) from 0 to 1.

    First the share of its surroundings, then that of each lamp of `rig`.
    """
    lamps = rig.lighting().lamps
    # A scene leaves its first lamp to shadows that move, so all of the rig's stand behind it here.
    scene = HeadScene(head_model(head), np.concatenate([lamps[:1], lamps]))
    count = scene.skin_vertices
    under_hair = scene.reach[:count, :1]
    reach = scene.reach[:count, 1:] * np.concatenate([under_hair, np.ones((count, len(lamps) - 1))], axis=1)
    return np.concatenate([scene.attributes[:count, OCCLUSION, None], reach], axis=1)
