"""The cloth over the shoulders: where its neckline runs, and how far it stands off the skin."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from ..machine.kernels.jit import f4
from .anatomy import Anatomy, smoothstep

COLLAR = f4(13)  # mm: width of the collar
_THICKNESS = 2.6  # mm


def neckline(anatomy: Anatomy) -> Array:
    """Return the distance (N1,) in mm from a round neckline into the cloth, negative on bare skin."""
    p, u = anatomy.skin, anatomy.unit
    base = anatomy.chin - 46.0 * u
    height = base - 0.30 * (p[:, 2] + 46.0 * u)
    return np.asarray(np.minimum(height - p[:, 1], 200.0))


def cloth_offset(depth: Array, normals: Array) -> Array:
    """Return displacements (N1, 3) mm from the skin to the cloth; the collar is thicker than the rest.

    `depth` (N1,) is that of `neckline`, `normals` (N1, 3) the skin's.
    """
    amount = smoothstep(-1.5, 3.0, depth) * (
        1.0 - 0.35 * smoothstep(float(COLLAR), float(COLLAR) + 6.0, depth)
    )
    return _THICKNESS * amount[:, None] * normals
