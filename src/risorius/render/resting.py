"""The light that reaches the skin of a head at rest, for programs that draw the head themselves."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Float32Array
from ..face.head.head import Head
from ..looks.attributes import OCCLUSION
from ..looks.head_model import head_model
from .lights import LightRig
from .scene import HeadScene


def light_at_rest(head: Head, rig: LightRig) -> Float32Array:
    """Return the light that reaches each of the skin's N1 vertices at rest: shares (N1, 1 + lamps), 0 to 1.

    First the share of its surroundings, then that of each lamp of `rig`; of the first what hair leaves of it,
    since the shadow that the face itself casts in its light moves with it.
    """
    scene = HeadScene(head_model(head), rig.lighting().lamps)
    count = scene.skin_vertices
    return np.concatenate(
        [scene.attributes[:count, OCCLUSION, None], scene.reach[:count, : len(rig.lamps)]], axis=1
    )
