"""The gap between the lips at 19 places from corner to corner, on any skin of a head."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ...core.arrays import Array, FloatArray, Int32Array
from ..contact.contact import Contacts, find_contacts
from ..contact.mouth import STATIONS, Mouth
from ..head.head import Head

APART = 0.3  # mm between the lips while their slopes are measured, so that they do not overlap
SHIFTS = 0.5, 1.0  # mm to either side, and to the front and back, that the lower lip moves for that
NEAR = 0.75  # of the distance between two places: contacts that are nearer belong to a place


@dataclass(frozen=True, slots=True)
class MouthGap:
    """The 19 places of a head's mouth, from its right corner to its left.

    `vertices`, `share` (19, 4): level-1 vertices of the two points that meet at each place at rest, one on
    each lip, and their shares in these points, negative for the lower lip. `rest` (19,) mm: the gap there at
    rest. `slope` (19, 2): how much the gap grows when the lower lip moves by 1 mm to the left, and to the
    front.
    """

    vertices: Int32Array
    share: Array
    rest: Array
    slope: Array

    @classmethod
    @lru_cache(maxsize=4)
    def of(cls, head: Head) -> MouthGap:
        """Return the places of `head`, which are the same for the same head."""
        mouth = Mouth.of(head)
        skin = np.asarray(head.skin.matrix @ head.rest)
        vertices = np.zeros((len(mouth.line), 4), np.int32)
        share = np.zeros(vertices.shape)
        for place, row in enumerate(mouth.line):
            met = np.flatnonzero(row)
            vertices[place, : len(met)], share[place, : len(met)] = mouth.vertices[met], row[met]
        gap = cls(vertices, share, np.zeros(STATIONS), _slopes(mouth, skin))
        return replace(gap, rest=gap.between(gap.corners(skin))[:, 1])

    def __call__(self, skin: FloatArray) -> Array:
        """Return the gap (19,) in mm on a level-1 skin (N1, 3) beyond the gap at rest; negative: overlap."""
        return np.asarray(self.between(self.corners(skin))[:, 1] - self.rest)

    def between(self, corners: Array) -> Array:
        """Return the ways (..., 19, 3) in mm from the lower lip's point to the upper one's."""
        return np.asarray((self.share[:, :, None] * corners).sum(axis=-2))

    def corners(self, skin: FloatArray) -> Array:
        """Return the places' vertices (..., 19, 4, 3) of level-1 skins (..., N1, 3)."""
        return np.asarray(skin.take(self.vertices, axis=-2), dtype=np.float64)


def _slopes(mouth: Mouth, skin: Array) -> Array:
    """Return how the narrowest gap about each place changes as the lower lip moves aside and forwards."""
    points = skin[mouth.vertices]
    lower = np.setdiff1d(mouth.facing.lower, mouth.facing.upper)
    middle = 0.5 * np.abs(mouth.line) @ points
    result = np.zeros((len(mouth.line), 2))
    for column, (axis, by) in enumerate(zip((0, 2), SHIFTS, strict=True)):
        gaps = []
        for way in (-by, by):
            moved = points.copy()
            moved[lower, 1] -= APART
            moved[lower, axis] += way
            gaps.append(_narrowest(mouth, moved, middle[:, 0]))
        result[:, column] = (gaps[1] - gaps[0]) / (2.0 * by)
    return np.nan_to_num(result)


def _narrowest(mouth: Mouth, points: Array, places: Array) -> Array:
    """Return the narrowest gap about each of some places (19,) mm in x; NaN where there is no contact."""
    contacts = Contacts.allocate(len(mouth.facing.vertices))
    count = find_contacts(mouth.facing, np.pad(points, ((0, 0), (0, 1))), np.inf, contacts)
    reach = NEAR * (places[-1] - places[0]) / (len(places) - 1)
    near = np.abs(contacts.x[:count] - places[:, None]) < reach
    gaps = np.where(near, contacts.gap[:count], np.inf).min(axis=1)
    return np.where(np.isinf(gaps), np.nan, gaps)
