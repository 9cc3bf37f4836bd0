"""Skin that several muscles push together gives way before it folds over.

Distances between points of the mesh are limited. The ends of an edge keep a share of their distance along the
edge's direction. So does a corner of a face from the opposite edge, because a long narrow face can turn over
while none of its edges becomes shorter. No limit is tighter than what the strongest muscle alone leaves, so
single muscles stay exact. The limits are linear in the displacement before the jaw turns it. Sweeps of equal
pushes meet them (position-based dynamics, Müller et al. 2007, one-sided constraints), which is continuous in
every activation.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from ...core.arrays import AnyArray, Array, BoolArray, Int32Array, IntArray, UInt32Array
from ...machine.array_cache import cached_arrays
from ...machine.kernels.jit import kernel
from ..head.head import Head
from ..numerics.mesh_sides import unique_pairs
from .muscles import fields_of

LEAST = 0.6  # share of an edge's length at rest that remains along its direction
LEAST_WIDTH = 0.5  # share of a face's width at rest that remains
STEEPEST = 0.5  # share of a face's width at rest by which a corner may leave the plane of the face
LAID_OVER = 1.2  # share of a face's width: if all muscles together narrow and lift it more, it may fold over
TURNING = 0.9  # share of a face's width: if all muscles together narrow it more, it may turn over
SWEEPS = 20
ALL = 5  # sweeps from one over all distances to the next
CLOSE = 0.3  # mm from its allowance: pushes elsewhere may bring a distance beyond it
NEAR = 1e-2  # mm: shorter distances at rest are left out


@dataclass(frozen=True, slots=True)
class Distances:
    """Distances of points from places on edges of the mesh.

    `points` (d, 3): a point, and the ends of an edge; `foot` (d,): the place on the edge, 0 at its first end
    and 1 at its second; `way` (d, 3): the unit direction from the point to the place; `length` (d,): the
    distance in mm at rest.
    """

    points: Int32Array
    foot: Array
    way: Array
    length: Array

    @classmethod
    def of(cls, points: IntArray, rest: Array) -> Distances:
        """Measure at `rest` (n, 3) the distance of each first point from the edge of the other two.

        Both ends of an edge may be the same point.
        """
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
        """Return by how many mm (d,) a displacement (n, 3) shortens each distance; negative if it grows."""
        first, second, third = (displacement[self.points[:, k]] for k in range(3))
        apart = second + self.foot[:, None] * (third - second) - first
        return np.asarray(-(apart * self.way).sum(axis=1))


@dataclass(frozen=True, slots=True)
class FoldPrevention:
    """The distances that muscles could fold over; each may shorten by its `allowance` (d,) mm.

    `close` (d,) is the workspace of `resolve_folds`: not for two threads at a time.
    """

    distances: Distances
    allowance: Array
    close: UInt32Array

    @classmethod
    def of(cls, head: Head) -> FoldPrevention:
        """Find the distances that all muscles of `head` together could shorten too far."""
        *distances, allowance = _tables(head)
        return cls(Distances(*distances), allowance, np.empty(len(allowance), np.uint32))

    def resolve(self, displacement: Array) -> None:
        """Change `displacement` (N0, 3) mm in place until no distance is too short."""
        distances = self.distances
        tables = distances.points, distances.foot, distances.way, self.allowance
        resolve_folds(*tables, SWEEPS, self.close, displacement)


@lru_cache(maxsize=4)
def _tables(head: Head) -> tuple[AnyArray, ...]:
    fields = _fields(head)
    return cached_arrays("crowding", [head.rest, head.quads, *fields], lambda: _at_risk(head, fields))


def _at_risk(head: Head, fields: list[Array]) -> tuple[Array, ...]:
    """Return the columns of the `Distances` that all `fields` could shorten too far, then the allowances."""
    edges, widths = struts(head.quads), altitudes(head.quads)
    along, across = Distances.of(edges[:, [0, 1, 1]], head.rest), Distances.of(widths, head.rest)
    narrowed = _shortened(across, fields)
    limits = [
        _limits(along, _shortened(along, fields), 1.0 - LEAST, 1.0 - LEAST),
        _limits(across, narrowed, 1.0 - LEAST_WIDTH, TURNING),
        *_tilts(across, np.sum(narrowed, axis=0), fields, head.rest),
    ]
    tables = [(d.points, d.foot, d.way, d.length, allowance) for d, allowance in limits]
    return tuple(np.concatenate(parts) for parts in zip(*tables, strict=True))


def struts(quads: IntArray) -> IntArray:
    """Return the sides and diagonals (e, 2) of `quads` (Q, 4), each once."""
    ends = [quads[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3))]
    return unique_pairs(np.vstack(ends))


def altitudes(quads: IntArray) -> IntArray:
    """Return each corner of `quads` (Q, 4) with the ends of each opposite side (8 Q, 3)."""
    turned = [np.roll(quads, -k, axis=1) for k in range(4)]
    return np.vstack([t[:, order] for t in turned for order in ([0, 3, 2], [1, 2, 3])])


def _limits(
    distances: Distances, shortened: list[Array], most: float, turning: float
) -> tuple[Distances, Array]:
    """Return the `distances` at risk, and by how many mm each may shorten.

    A distance may shorten by the share `most`, or by as much as a muscle alone shortens it (`shortened`, (d,)
    mm for each). It is at risk if all muscles together shorten it by more than that and by more than the
    share `turning`.
    """
    allowance = np.maximum(most * distances.length, np.max(shortened, axis=0))
    risky = np.sum(shortened, axis=0) > np.maximum(allowance, turning * distances.length)
    return distances.only(risky), allowance[risky]


def _tilts(
    widths: Distances, crowded: Array, fields: list[Array], rest: Array
) -> Iterator[tuple[Distances, Array]]:
    """Yield the `widths` that all `fields` together could halve and fold over, and how far corners may rise.

    `crowded` (d,) mm: by how much all fields shorten each. Corners are measured out of the plane of their
    three points at `rest` (N0, 3), first to the one side, then to the other.
    """
    base = rest[widths.points[:, 2]] - rest[widths.points[:, 1]]
    normal = np.cross(base, widths.way)
    heights = replace(widths, way=normal / np.linalg.norm(normal, axis=1, keepdims=True))
    risen = [heights.shortened(field) for field in fields]
    for side in (1.0, -1.0):
        raised = [np.maximum(side * each, 0.0) for each in risen]
        risky = crowded + np.sum(raised, axis=0) > LAID_OVER * widths.length
        risky &= crowded > (1.0 - LEAST_WIDTH) * widths.length
        allowance = np.maximum(STEEPEST * widths.length, np.max(raised, axis=0))
        yield replace(heights, way=side * heights.way).only(risky), allowance[risky]


def _shortened(distances: Distances, fields: list[Array]) -> list[Array]:
    return [np.maximum(distances.shortened(field), 0.0) for field in fields]


def _fields(head: Head) -> list[Array]:
    """Return the displacement (N0, 3) of every muscle and of every joint field at 1, both sides together."""
    whole_fields: dict[int, Array] = {}
    for row in fields_of(head):
        whole = whole_fields.setdefault(row.muscle, np.zeros_like(head.rest))
        whole[row.field.vertices] += row.field.displacement
    return list(whole_fields.values())


@kernel("i4[:, :], f8[:], f8[:, :], f8[:], i8, u4[:], f8[:, :]")
def resolve_folds(
    points: Int32Array,
    foot: Array,
    way: Array,
    allowance: Array,
    sweeps: int,
    close: UInt32Array,
    displacement: Array,
) -> None:
    """Push points apart whose distance shortens by more than `allowance` (d,) mm along `way` (d, 3).

    The tables are those of `Distances`; `close` (d,) is scratch.

    `displacement` (n, 3) mm is changed in place, in at most `sweeps` sweeps. Every `ALL` sweeps all distances
    are looked at, between them those that were then within `CLOSE` of their allowance.
    """
    count = 0
    for sweep in range(sweeps):
        every = sweep % ALL == 0
        looked, count = (len(points), 0) if every else (count, count)
        moved = False
        for j in range(looked):
            k = j if every else int(close[j])
            first, second, third = points[k, 0], points[k, 1], points[k, 2]
            far = foot[k]
            near = 1.0 - far
            excess = -allowance[k]
            for c in range(3):
                other = near * displacement[second, c] + far * displacement[third, c]
                excess += (displacement[first, c] - other) * way[k, c]
            if every and excess > -CLOSE:
                close[count] = k
                count += 1
            if excess > 0.0:
                moved = True
                push = excess / (1.0 + near * near + far * far)
                for c in range(3):
                    displacement[first, c] -= push * way[k, c]
                    displacement[second, c] += near * push * way[k, c]
                    displacement[third, c] += far * push * way[k, c]
        if every and not moved:
            break
