"""Skin that several muscles push together gives way before it folds over.

What is limited are distances of points of the mesh: the ends of an edge keep a share of their distance along
the edge's own direction, and so does a corner of a face from the edge across, for a long narrow face turns
over while no edge of it grows shorter. What the hardest muscle alone leaves is always left: so muscles alone
stay exact. The limits are linear in the displacement before the jaw turns it, and are met by sweeps of equal
pushes (position-based dynamics, Müller et al. 2007, one-sided constraints), which is continuous in every
activation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays import Array, BoolArray, Int32Array, IntArray
from ..core.kernels.jit import kernel
from ..core.parameters import PARAMETERS
from .head import Head
from .muscles import ELSEWHERE

LEAST = 0.6  # of an edge's length at rest that is left to it along its direction
LEAST_WIDTH = 0.5  # of a face's width at rest that is left to it
STEEPEST = 0.5  # of a face's width at rest, by which a corner may leave its plane
LAID_OVER = 1.2  # of a face's width: lost and risen by all muscles together where they could lay it over
TURNING = 0.9  # of a face's width: lost by all muscles together where they could turn it over
SWEEPS = 20
NEAR = 1e-2  # mm: distances at rest are longer


@dataclass(frozen=True, slots=True)
class Distances:
    """Distances of points from points on edges of the mesh: from `points` (d, 3) the first, to the place
    `foot` (d,), 0 to 1, on the way from the second to the third; `way` (d, 3) is their unit direction and
    `length` (d,) their length in mm at rest.
    """

    points: Int32Array
    foot: Array
    way: Array
    length: Array

    @classmethod
    def of(cls, points: IntArray, rest: Array) -> Distances:
        """Measure, at rest (n, 3), each first point from the edge of the other two, which may be one."""
        first, second, third = (rest[points[:, k]] for k in range(3))
        base = third - second
        along = ((first - second) * base).sum(axis=1) / np.maximum((base * base).sum(axis=1), NEAR**2)
        foot = np.clip(along, 0.0, 1.0)
        vector = second + foot[:, None] * base - first
        length = np.linalg.norm(vector, axis=1)
        long = length > NEAR
        way = vector[long] / length[long, None]
        return cls(points[long].astype(np.int32), foot[long], way, length[long])

    def only(self, chosen: BoolArray) -> Distances:
        """Return those that are `chosen` (d,)."""
        return Distances(self.points[chosen], self.foot[chosen], self.way[chosen], self.length[chosen])

    def shortened(self, displacement: Array) -> Array:
        """Return by how many mm (d,) a displacement (n, 3) shortens them; below 0 where it lengthens them."""
        first, second, third = (displacement[self.points[:, k]] for k in range(3))
        apart = second + self.foot[:, None] * (third - second) - first
        return np.asarray(-(apart * self.way).sum(axis=1))


@dataclass(frozen=True, slots=True)
class Crowding:
    """What muscles could fold over: distances of points, and the most in mm by which each may shorten, `room`
    (d,).
    """

    distances: Distances
    room: Array

    @classmethod
    def of(cls, head: Head) -> Crowding:
        """Find what all muscles of `head` together could shorten to less than is left to it."""
        fields = _fields(head)
        edges, widths = struts(head.quads), altitudes(head.quads)
        across = Distances.of(widths, head.rest)
        limits = [
            _limits(Distances.of(edges[:, [0, 1, 1]], head.rest), fields, 1.0 - LEAST, 1.0 - LEAST),
            _limits(across, fields, 1.0 - LEAST_WIDTH, TURNING),
            *(_tilts(across, fields, head.rest, side) for side in (1.0, -1.0)),
        ]
        tables = [(d.points, d.foot, d.way, d.length, room) for d, room in limits]
        *found, room = (np.concatenate(parts) for parts in zip(*tables, strict=True))
        return cls(Distances(*found), room)

    def relieve(self, displacement: Array) -> None:
        """Change `displacement` (N0, 3) mm in place until nothing is shorter than it may be."""
        found = self.distances
        relieve(found.points, found.foot, found.way, self.room, SWEEPS, displacement)


def struts(quads: IntArray) -> IntArray:
    """Return the sides and diagonals (e, 2) of `quads` (Q, 4), each once."""
    ends = [quads[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3))]
    return np.asarray(np.unique(np.sort(np.vstack(ends), axis=1), axis=0))


def altitudes(quads: IntArray) -> IntArray:
    """Return each corner of `quads` (Q, 4) with the ends of either side that it does not lie on (8 Q, 3)."""
    turned = [np.roll(quads, -k, axis=1) for k in range(4)]
    return np.vstack([t[:, order] for t in turned for order in ([0, 3, 2], [1, 2, 3])])


def _limits(found: Distances, fields: list[Array], most: float, turning: float) -> tuple[Distances, Array]:
    """Return those of the distances `found` that all `fields` together shorten by more than their share
    `turning` and than they may, and by how much each may: by the share `most`, or as one field alone does.
    """
    shortened = _shortened(found, fields)
    room = np.maximum(most * found.length, np.max(shortened, axis=0))
    risky = np.sum(shortened, axis=0) > np.maximum(room, turning * found.length)
    return found.only(risky), room[risky]


def _tilts(widths: Distances, fields: list[Array], rest: Array, side: float) -> tuple[Distances, Array]:
    """Return those of `widths` that all `fields` together could halve and lay over, measured out of the plane
    of their three points at `rest` (N0, 3), to the `side` 1 or -1, and how far each corner may go.
    """
    crowded = np.sum(_shortened(widths, fields), axis=0)
    base = rest[widths.points[:, 2]] - rest[widths.points[:, 1]]
    normal = np.cross(base, widths.way)
    found = replace(widths, way=side * normal / np.linalg.norm(normal, axis=1, keepdims=True))
    left = _shortened(found, fields)
    risky = crowded + np.sum(left, axis=0) > LAID_OVER * widths.length
    risky &= crowded > (1.0 - LEAST_WIDTH) * widths.length
    return found.only(risky), np.maximum(STEEPEST * widths.length, np.max(left, axis=0))[risky]


def _shortened(found: Distances, fields: list[Array]) -> list[Array]:
    return [np.maximum(found.shortened(field), 0.0) for field in fields]


def _fields(head: Head) -> list[Array]:
    """Return the displacement (N0, 3) of every muscle at 1, of both sides together."""
    found: dict[str, Array] = {}
    for p in PARAMETERS:
        if p.name in head.fields and p.base not in ELSEWHERE:
            whole = found.setdefault(p.base, np.zeros_like(head.rest))
            whole[head.fields[p.name].vertices] += head.fields[p.name].displacement
    return list(found.values())


@kernel
def relieve(
    points: Int32Array, foot: Array, way: Array, room: Array, sweeps: int, displacement: Array
) -> None:
    """Push points apart that come nearer than by `room` (d,) mm along `way` (d, 3): `Distances`' tables.

    `displacement` (n, 3) mm is changed in place, in at most `sweeps` sweeps.
    """
    for _ in range(sweeps):
        moved = False
        for k in range(len(points)):
            first, second, third = points[k, 0], points[k, 1], points[k, 2]
            far = foot[k]
            near = 1.0 - far
            excess = -room[k]
            for c in range(3):
                other = near * displacement[second, c] + far * displacement[third, c]
                excess += (displacement[first, c] - other) * way[k, c]
            if excess > 0.0:
                moved = True
                push = excess / (1.0 + near * near + far * far)
                for c in range(3):
                    displacement[first, c] -= push * way[k, c]
                    displacement[second, c] += near * push * way[k, c]
                    displacement[third, c] += far * push * way[k, c]
        if not moved:
            break
