"""The eyeballs: both look at one point, at the gaze's direction and distance."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .rotations import direction, forward_to

Array = npt.NDArray[np.float64]
MM_PER_M = 1000.0


def eye_rotations(centres: Array, pitch: float, yaw: float, distance: float) -> Array:
    """Return the rotations (2, 3, 3) of the left and the right eye within the head.

    `centres` (2, 3) mm, about the origin of the head frame; `pitch`, `yaw` in degrees, up and to the
    subject's left positive, are those of a single eye at the origin; `distance` in m is that of the point
    on which the eyes converge. No torsion (Listing's law).
    """
    point = direction(pitch, yaw) * (distance * MM_PER_M)
    towards = point - centres
    towards /= np.linalg.norm(towards, axis=1, keepdims=True)
    return np.stack([forward_to(towards[0]), forward_to(towards[1])])


def pitch_and_yaw(rotation: Array) -> tuple[float, float]:
    """Return the direction of one eye's rotation (3, 3) in degrees: up, and to the subject's left."""
    x, y, z = (float(a) for a in rotation[:, 2])
    return float(np.degrees(np.arcsin(np.clip(y, -1.0, 1.0)))), float(np.degrees(np.arctan2(x, z)))
