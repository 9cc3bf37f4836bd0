"""The coordinates of tables of places: the left half of the face at rest, in proportion to the eyes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, FloatArray
from .head import Head

EYE_DISTANCE = 57.8  # mm between the eyes of the face on which the tables' places were measured
_RIPPLES = 6


@dataclass(frozen=True, slots=True)
class FaceCoordinates:
    """The 68 landmarks at rest (68, 3), and the scale of the face: its mm per mm of the tables."""

    landmarks: Array
    unit: float

    @classmethod
    def of(cls, head: Head) -> FaceCoordinates:
        """Measure a head."""
        unit = float(np.linalg.norm(head.eye_centre[0] - head.eye_centre[1])) / EYE_DISTANCE
        return cls(head.landmarks(head.skin.matrix @ head.rest) / unit, unit)

    def left_half(self, points: Array) -> Array:
        """Return points (n, 3) in mm of the tables; the right half is mirrored to the left."""
        places = points / self.unit
        places[:, 0] = np.abs(places[:, 0])
        return np.asarray(places)

    def mean(self, landmarks: Sequence[int]) -> Array:
        """Return the mean (3,) of some landmarks."""
        return np.asarray(self.landmarks[list(landmarks)].mean(axis=0))


def smooth(low: float, high: float, x: FloatArray) -> Array:
    """Return 0 below `low`, 1 above `high`, and a smooth step between them."""
    t = np.clip((np.asarray(x, np.float64) - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def plateau(edges: Sequence[float], x: FloatArray) -> Array:
    """Return the soft plateau that begins, is full, is still full and ends at the four `edges`."""
    return smooth(edges[0], edges[1], x) * (1.0 - smooth(edges[2], edges[3], x))


def ripple(points: Array, wavelength: float, seed: int) -> Array:
    """Return smooth random heights (n,) of variance 1/2 at `points` (n, k), the same for a seed."""
    generator = np.random.default_rng(seed)
    total = np.zeros(len(points))
    for _ in range(_RIPPLES):
        way = generator.normal(size=points.shape[1]) * 2.0 / wavelength
        total += np.sin(points @ way + generator.uniform(0.0, 2.0 * np.pi))
    return np.asarray(total / np.sqrt(_RIPPLES))
