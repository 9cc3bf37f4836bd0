"""The eyeballs: both look at one point, in the direction and at the distance of the gaze."""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import Array
from ..numerics.rotations import forward_rows, towards

MM_PER_M = 1000.0


def eye_rotations(centres: Array, pitch: float, yaw: float, distance: float) -> Array:
    """Return the rotations (2, 3, 3) of the left and the right eye within the head.

    `centres` (2, 3) mm, about the origin of the head frame; `pitch`, `yaw` in degrees, up and to the
    subject's left positive, are those of a single eye at the origin; `distance` in m is that of the point
    on which the eyes converge. No torsion (Listing's law).
    """
    far = distance * MM_PER_M
    to_point = towards(pitch, yaw)
    rows = []
    for centre in centres.tolist():
        x, y, z = (far * there - here for there, here in zip(to_point, centre, strict=True))
        length = math.sqrt(x * x + y * y + z * z)
        rows.append(forward_rows(x / length, y / length, z / length))
    return np.array(rows)


def pitch_and_yaw(rotation: Array) -> tuple[float, float]:
    """Return the direction of one eye's rotation (3, 3) in degrees: up, and to the subject's left."""
    x, y, z = rotation[:, 2].tolist()
    return math.degrees(math.asin(min(max(y, -1.0), 1.0))), math.degrees(math.atan2(x, z))
