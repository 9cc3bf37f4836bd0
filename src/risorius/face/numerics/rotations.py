"""Rotation matrices of the head frame: +x to the subject's left, +y up, +z forward."""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import Array


def about_axis(axis: Array, angle: float) -> Array:
    """Return the (3, 3) right-handed rotation by `angle` radians about the unit vector `axis` (3,)."""
    x, y, z = axis.tolist()
    s, c = math.sin(angle), math.cos(angle)
    k = 1.0 - c
    return np.array(
        [
            [c + k * x * x, k * x * y - s * z, k * x * z + s * y],
            [k * x * y + s * z, c + k * y * y, k * y * z - s * x],
            [k * x * z - s * y, k * y * z + s * x, c + k * z * z],
        ]
    )


def turned(vectors: Array, axis: Array, angles: Array | float) -> Array:
    """Return `vectors` (n, 3) turned about the unit `axis` (3,) by `angles` (n,) radians."""
    angle: Array = np.broadcast_to(angles, len(vectors))[:, None]
    along = (vectors @ axis)[:, None] * axis
    return np.asarray(along + (vectors - along) * np.cos(angle) + np.cross(axis, vectors) * np.sin(angle))


def head_rotation(pitch: float, yaw: float, roll: float) -> Array:
    """Return the (3, 3) rotation of the head; degrees, up, to the subject's left and tilted left positive.

    The head tilts first, then nods, then turns, so that a nod of a turned head is still a nod.
    """
    p, y, r = math.radians(pitch), math.radians(yaw), math.radians(roll)
    sp, cp, sy, cy, sr, cr = math.sin(p), math.cos(p), math.sin(y), math.cos(y), math.sin(r), math.cos(r)
    return np.array(
        [
            [cy * cr + sy * sp * sr, cy * sr - sy * sp * cr, sy * cp],
            [-cp * sr, cp * cr, sp],
            [cy * sp * sr - sy * cr, -sy * sr - cy * sp * cr, cy * cp],
        ]
    )


def rotation_angles(rotation: Array) -> tuple[float, float, float]:
    """Return pitch, yaw and roll in degrees of a head's rotation (3, 3): the inverse of `head_rotation`."""
    pitch = math.asin(min(max(float(rotation[1, 2]), -1.0), 1.0))
    yaw = math.atan2(float(rotation[0, 2]), float(rotation[2, 2]))
    roll = math.atan2(float(rotation[1, 0]), float(rotation[1, 1]))
    return math.degrees(pitch), math.degrees(yaw), -math.degrees(roll)


def direction(pitch: float, yaw: float) -> Array:
    """Return the unit vector (3,) at `pitch` degrees up and `yaw` degrees to the subject's left of +z."""
    return np.array(towards(pitch, yaw))


def towards(pitch: float, yaw: float) -> tuple[float, float, float]:
    """Return x, y and z of `direction`."""
    p, y = math.radians(pitch), math.radians(yaw)
    return math.cos(p) * math.sin(y), math.sin(p), math.cos(p) * math.cos(y)


def forward_rows(x: float, y: float, z: float) -> list[list[float]]:
    """Return the rows of the rotation without torsion (Listing's law) that takes +z to x, y, z, of length 1.

    It must lie in front (z > −1).
    """
    k = 1.0 / (1.0 + z)
    return [[1.0 - k * x * x, -k * x * y, x], [-k * x * y, 1.0 - k * y * y, y], [-x, -y, z]]
