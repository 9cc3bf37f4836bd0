"""The parting of hair at the side: where it runs, and how hair lies beside it."""

from __future__ import annotations

import numpy as np

from ..core.arrays import Array
from .anatomy import Anatomy, smoothstep
from .noise import noise_at
from .surface import flat, unit

PARTING = -24.0  # mm: x of the parting at the hairline
_WHORL = -14.0, -92.0  # mm: x and z of the crown's whorl, at which it ends
_BEFORE = 60.0  # mm: z of its other end, before the hairline


def parted(anatomy: Anatomy, points: Array) -> Array:
    """Return how near, 0..1, points (n, 3) of the scalp are to the parting, which ends at the whorl."""
    u = anatomy.unit
    beside = np.exp(-((from_parting(anatomy, points)[1] / (11.0 * u)) ** 2))
    return beside * smoothstep(30.0 * u, 50.0 * u, points[:, 1] - anatomy.eye_height)


def near_whorl(anatomy: Anatomy, points: Array) -> Array:
    """Return how near, 0..1, points (n, 3) are to the whorl, from which hairs spread."""
    u = anatomy.unit
    distance = np.hypot(points[:, 0] / u - _WHORL[0], points[:, 2] / u - _WHORL[1])
    above = smoothstep(30.0 * u, 50.0 * u, points[:, 1] - anatomy.eye_height)
    return np.asarray(np.exp(-((distance / 30.0) ** 2)) * above)


def beside_parting(anatomy: Anatomy, place: Array) -> Array:
    """Return by which share (S,) hair at places (S, 3) rises: it lies flat at the parting."""
    return 0.12 + 0.88 * smoothstep(0.0, 70.0, from_parting(anatomy, place)[1] / anatomy.unit)


def aside(anatomy: Anatomy, points: Array, normals: Array) -> Array:
    """Return unit directions (n, 3) of hair at the hairline: back, and away from the parting."""
    away, distance = from_parting(anatomy, points)
    sideways = 0.9 * away[:, 0] * np.tanh(distance / (14.0 * anatomy.unit))
    ways = np.stack([sideways, np.zeros(len(points)), np.full(len(points), -1.0)], axis=1)
    return flat(unit(ways) + wander(points), normals)


def combed(anatomy: Anatomy, place: Array) -> Array:
    """Return directions (S, 3) of hair at places (S, 3): from the parting aside and back, and then down."""
    u = anatomy.unit
    away, distance = from_parting(anatomy, place)
    away = away * np.tanh(distance / (8.0 * u))[:, None]
    high = smoothstep(35.0 * u, 88.0 * u, place[:, 1] - anatomy.eye_height)
    back = 1.0 - smoothstep(-40.0 * u, 10.0 * u, place[:, 2])
    ways = np.stack([away[:, 0] * high, -1.1 * (1.0 - high), (away[:, 1] - 0.5 * back) * high - 0.06], axis=1)
    return np.asarray(unit(ways) + wander(place))


def wander(points: Array) -> Array:
    """Return by how much directions (n, 3) at points (n, 3) wander."""
    return 0.06 * np.stack([noise_at(points + shift, 60.0) for shift in (0.0, 91.0, 57.0)], axis=1)


def from_parting(anatomy: Anatomy, points: Array) -> tuple[Array, Array]:
    """Return the directions (n, 2) in x and z from the parting to points (n, 3), and the distances in mm."""
    start = np.array([PARTING, _BEFORE]) * anatomy.unit
    line = np.array(_WHORL) * anatomy.unit - start
    offset = points[:, [0, 2]] - start
    way = np.clip(offset @ line / (line @ line), 0.0, 1.0)[:, None]
    away = offset - way * line
    distance = np.hypot(away[:, 0], away[:, 1])
    return away / np.maximum(distance, 1e-9)[:, None], distance
