"""The light that reaches the skin of a head at rest, for programs that draw the head themselves."""

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
    # A scene bakes no shadow of its first lamp, so a copy of that lamp stands before all lamps of the rig.
    scene = HeadScene(head_model(head), np.concatenate([lamps[:1], lamps]))
    count = scene.skin_vertices
    under_hair = scene.reach[:count, :1]
    reach = scene.reach[:count, 1:] * np.concatenate([under_hair, np.ones((count, len(lamps) - 1))], axis=1)
    return np.concatenate([scene.attributes[:count, OCCLUSION, None], reach], axis=1)
