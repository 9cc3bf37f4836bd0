"""The jaw: a frame that turns about the hinge axis and carries teeth, tongue and skin.

Each vertex of the skin turns by its share of the rotation, with its fields; a linear corrective adds what the
rigid rotation does not explain (facts: face-model, section 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...core.arrays import Array, FloatArray
from ...core.parameters import INDEX
from ...machine.array_cache import cached_arrays
from ...machine.kernels.jit import kernel
from ..head.head import Head
from ..numerics.rotations import about_axis, turned
from .throat import resolve_throat_folds

MASSETER = INDEX["masseter"]


@dataclass(frozen=True, slots=True)
class Jaw:
    """The hinge of a head: `point` (3,) mm, unit `axis` (3,), `angle` radians at full opening.

    `weight` (N0,) is each skin vertex's share of the rotation, `corrective` (N0, 3) mm is added after it.
    """

    point: Array
    axis: Array
    angle: float
    weight: Array
    corrective: Array

    @classmethod
    @lru_cache(maxsize=4)
    def of(cls, head: Head) -> Jaw:
        """Take the jaw of `head`; its corrective keeps throats of other ages and shapes from folding."""
        corrective = np.zeros_like(head.rest)
        corrective[head.jaw_corrective.vertices] = head.jaw_corrective.displacement
        angle, below = head.jaw_weight * head.jaw_angle, head.rest[head.masks["lips"] > 0.5, 1].min()

        def without_folds() -> tuple[Array]:
            rigid = head.jaw_point + turned(head.rest - head.jaw_point, head.jaw_axis, angle)
            opened = rigid + corrective
            resolve_throat_folds(head.quads, head.rest, below, head.jaw_axis, angle, opened)
            return (opened - rigid,)

        inputs = head.quads, head.rest, below, head.jaw_point, head.jaw_axis, angle, corrective
        (corrective,) = cached_arrays("jaw", inputs, without_folds)
        return cls(head.jaw_point, head.jaw_axis, head.jaw_angle, head.jaw_weight, corrective)

    def carry_skin(self, rest: Array, displacement: Array, opening: float, out: Array) -> None:
        """Write the skin (N0, 4), moved by `displacement` and by the jaw at `opening` 0..1, to `out`."""
        _carry(
            rest, displacement, self.weight, self.corrective, self.point, self.axis, self.angle, opening, out
        )

    def carry(self, points: Array, opening: float) -> Array:
        """Return `points` (n, 3) turned rigidly with the jaw at `opening` 0..1."""
        out = np.empty_like(points)
        self.carry_to(points, opening, out)
        return out

    def carry_to(self, points: Array, opening: float, out: FloatArray) -> None:
        """Write the result of `carry` to `out` (n, 3), of any precision."""
        turn_about(about_axis(self.axis, self.angle * opening), self.point, points, out)


@kernel("f8[:, :], f8[:], f8[:, :], f8[:, :]", "f8[:, :], f8[:], f8[:, :], f4[:, :]")
def turn_about(rotation: Array, point: Array, points: Array, out: FloatArray) -> None:
    """Write `points` (n, 3), turned by `rotation` (3, 3) about `point` (3,), to `out` (n, 3)."""
    for v in range(len(points)):
        x, y, z = points[v, 0] - point[0], points[v, 1] - point[1], points[v, 2] - point[2]
        for c in range(3):
            out[v, c] = rotation[c, 0] * x + rotation[c, 1] * y + rotation[c, 2] * z + point[c]


@kernel("f8[:, :], f8[:, :], f8[:], f8[:, :], f8[:], f8[:], f8, f8, f8[:, :]")
def _carry(
    rest: Array,
    displacement: Array,
    weight: Array,
    corrective: Array,
    point: Array,
    axis: Array,
    angle: float,
    opening: float,
    out: Array,
) -> None:
    ax, ay, az = axis[0], axis[1], axis[2]
    for v in range(len(rest)):
        x = rest[v, 0] + displacement[v, 0]
        y = rest[v, 1] + displacement[v, 1]
        z = rest[v, 2] + displacement[v, 2]
        turn = weight[v] * angle * opening
        if turn != 0.0:
            # Rodrigues' formula about the hinge.
            x, y, z = x - point[0], y - point[1], z - point[2]
            sine, versine = np.sin(turn), 1.0 - np.cos(turn)
            along = ax * x + ay * y + az * z
            x, y, z = (
                x + sine * (ay * z - az * y) + versine * (ax * along - x) + point[0],
                y + sine * (az * x - ax * z) + versine * (ay * along - y) + point[1],
                z + sine * (ax * y - ay * x) + versine * (az * along - z) + point[2],
            )
        out[v, 0] = x + opening * corrective[v, 0]
        out[v, 1] = y + opening * corrective[v, 1]
        out[v, 2] = z + opening * corrective[v, 2]
