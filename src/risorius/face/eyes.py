"""The eyeballs: both look at one point, in the direction and at the distance of the gaze."""

from __future__ import annotations

import math

import numpy as np

from ..core.arrays import Array
from .rotations import direction, forward_to

MM_PER_M = 1000.0


def eye_rotations(centres: Array, pitch: float, yaw: float, distance: float) -> Array:
    """Return the rotations (2, 3, 3) of the left and the right eye within the head.

    `centres` (2, 3) mm, about the origin of the head frame; `pitch`, `yaw` in degrees, up and to the
    subject's left positive, are those of a single eye at the origin; `distance` in m is that of the point
    on which the eyes converge. No torsion (Listing's law).
    """
    towards = direction(pitch, yaw) * (distance * MM_PER_M) - centres
    rotations = np.empty((2, 3, 3))
    for eye, (x, y, z) in enumerate(towards.tolist()):
        far = math.sqrt(x * x + y * y + z * z)
        rotations[eye] = forward_to((x / far, y / far, z / far))
    return rotations


def pitch_and_yaw(rotation: Array) -> tuple[float, float]:
    """Return the direction of one eye's rotation (3, 3) in degrees: up, and to the subject's left."""
    x, y, z = rotation[:, 2].tolist()
    return math.degrees(math.asin(min(max(y, -1.0), 1.0))), math.degrees(math.atan2(x, z))
