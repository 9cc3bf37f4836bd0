"""The lips: which vertices touch when they close, and shapes whose lips are just together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from risorius.core.arrays import AnyArray
from risorius.face.numerics.subdivide import catmull_clark

from .bust import Bust
from .masks import smoothstep
from .section import MouthSections

# An edge of each loop about the mouth, from the outside of the lips inwards, in the base mesh.
RINGS = (
    (405, 406),
    (412, 413),
    (414, 415),
    (416, 417),
    (497, 498),
    (418, 419),
    (420, 421),
    (535, 536),
    (552, 553),
)
VERMILION = RINGS[0]  # along the border of the lips' red
_LINE = (418, 419)  # of them, the one nearest the line where the lips meet
_TOUCHING = 0.05  # mm left between lips that are together
_REACH = 2.1
_WIDTH = 21.5
_MIDDLE = -65.0  # y in mm about which the mouth lies


def lip_rings(bust: Bust) -> AnyArray:
    """Sorted vertices of all loops of the lips."""
    return np.unique([v for a, b in RINGS for v in bust.loop(a, b)])


def lip_sides(bust: Bust) -> AnyArray:
    """(N0,) 1 on the upper lip, -1 on the lower one, 0 at the corners and elsewhere."""
    sides = np.zeros(len(bust.ids))
    for a, b in RINGS:
        ring = np.array(bust.loop(a, b))
        ring = np.roll(ring, -int(np.argmin(bust.places[ring, 0])))
        right = int(np.argmax(bust.places[ring, 0]))
        arcs = [ring[1:right], ring[right + 1 :]]
        arcs.sort(key=lambda arc: float(bust.places[arc, 1].mean()))
        sides[arcs[0]], sides[arcs[1]] = -1.0, 1.0
    return sides


def lip_pairs(bust: Bust, rest: AnyArray) -> AnyArray:
    """(P, 2) upper and lower lip vertices that lie together at rest, mirror symmetric, by ascending x of the
    lower.

    Every vertex of the lower lip that has an upper one within reach stands in one pair, with the nearest.
    """
    sides = lip_sides(bust)
    half = (bust.places[:, 0] < _WIDTH) & (rest[:, 0] > -1e-6)
    lower, upper = np.flatnonzero(half & (sides < 0)), np.flatnonzero(half & (sides > 0))
    distance, nearest = cKDTree(rest[upper]).query(rest[lower])
    pairs = np.stack([upper[nearest], lower], axis=1)[distance < _REACH]
    both = np.unique(np.vstack([pairs, bust.mirror[pairs]]), axis=0)
    return both[np.argsort(rest[both[:, 1], 0], kind="stable")]


@dataclass(frozen=True)
class LipSeal:
    """Brings the lips of any shape together: each lip goes half of the way, column by column.

    `corner` is the vertex at the left corner; `share` (N0,) is about 0.5 on the upper lip, -0.5 on the lower
    one, and fades off smoothly around them.
    """

    sections: MouthSections
    share: AnyArray
    corner: int

    @classmethod
    def of(cls, bust: Bust) -> LipSeal:
        """Measure and move the lips of the identity as it comes."""
        sides = lip_sides(bust)
        skin = catmull_clark(len(bust.ids), bust.quads)
        ring = np.array(bust.loop(*_LINE))
        corner = int(ring[np.argmax(bust.places[ring, 0])])
        return cls(
            MouthSections.of(skin, sides, float((bust.rest - bust.places)[corner, 2])),
            _share(bust, sides),
            corner,
        )

    def together(self, points: AnyArray, *, close: bool = True) -> AnyArray:
        """Positions (N0, 3), mirror symmetric as given, whose lips touch without overlap.

        With `close` false, overlap is removed but lips that stand apart stay so.
        """
        result = points.copy()
        for _ in range(14):
            x, gaps = self.gaps(result)
            here = np.interp(np.abs(result[:, 0]), x, np.clip(gaps - _TOUCHING, -3.0, 3.0 if close else 0.0))
            result[:, 1] -= 0.7 * here * self.share
        return result

    def gaps(self, points: AnyArray) -> tuple[AnyArray, AnyArray]:
        """Places x (k,) from the middle to the corner, and the gaps (k,) in mm there, fading off beyond
        it.
        """
        x = np.linspace(0.0, 1.0, 25) * points[self.corner, 0]
        gaps = np.array([self.sections.gap(points, float(at) + 0.01) for at in x[:-1]])
        known = np.isfinite(gaps)
        return np.append(x[:-1][known], [x[-1], x[-1] + 3.0]), np.append(
            gaps[known], [0.6 * gaps[known][-1], 0.0]
        )

    def line(self, points: AnyArray, x: float = 0.01) -> AnyArray:
        """The point (3,) at `x` where the lips come nearest."""
        return self.sections.meeting(points, x)


def narrowed(bust: Bust, points: AnyArray, amount: float) -> AnyArray:
    """Positions (N0, 3) with the lips drawn together sideways by the share `amount`, and their corners
    forward.
    """
    lips = np.zeros(len(points))
    lips[lip_rings(bust)] = 1.0
    front = smoothstep(0.0, 14.0, bust.places[:, 2])  # the cheeks' inside stays off the molars
    pull = amount * front * bust.spread(lips, lips) * _near(bust, 20.0, 45.0, 30.0, 50.0)
    return points + np.stack([-pull * points[:, 0], 0.0 * pull, 0.12 * pull * np.abs(points[:, 0])], axis=1)


def _share(bust: Bust, sides: AnyArray) -> AnyArray:
    front = (sides != 0.0) & (bust.places[:, 2] > 10.0)
    return 0.5 * bust.spread(np.where(front, 1.0, 0.0), sides) * _near(bust, 25.0, 45.0, 24.0, 32.0)


def _near(bust: Bust, y_full: float, y_none: float, x_full: float, x_none: float) -> AnyArray:
    """(N0,) 1 near the mouth, 0 beyond `y_none` above and below it and `x_none` to either side."""
    across, away = np.abs(bust.places[:, 0]), np.abs(bust.places[:, 1] - _MIDDLE)
    return (1.0 - smoothstep(y_full, y_none, away)) * (1.0 - smoothstep(x_full, x_none, across))
