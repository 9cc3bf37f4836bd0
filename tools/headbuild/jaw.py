"""The jaw as a frame: one rigid rotation, a weight per vertex and what is left of the sculpted shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from risorius.core.arrays import AnyArray
from risorius.face.muscles.throat import resolve_throat_folds
from risorius.face.numerics.rotations import turned

from .bust import Bust
from .mouth import lip_rings


@dataclass(frozen=True)
class Jaw:
    """`point`, unit `axis`, `angle` (radians, full opening), `weight` (N0,), `corrective` (N0, 3) mm."""

    point: AnyArray
    axis: AnyArray
    angle: float
    weight: AnyArray
    corrective: AnyArray

    def turn(self, points: AnyArray, angles: AnyArray | float) -> AnyArray:
        """Rotate points (n, 3) about the jaw's axis by `angles` (n,) radians."""
        return self.point + turned(points - self.point, self.axis, angles)


def fit_jaw(bust: Bust, rest: AnyArray) -> Jaw:
    """Fit the frame to the sculpted jawOpen: the axis to the lower teeth, the weights to the skin."""
    teeth = bust.source.parts["helper-lower-teeth"].vertices
    shape = bust.shape("jawOpen")
    shape = 0.5 * (shape + shape[bust.mirror] * np.array([-1.0, 1.0, 1.0]))
    before = bust.body[teeth]
    rotation, shift = _rigid(before, before + bust.source.shape("jawOpen")[teeth])
    angle = float(np.arctan2(rotation[2, 1], rotation[1, 1]))
    plane = np.eye(2) - rotation[1:, 1:]
    point = np.concatenate([[0.0], np.linalg.solve(plane, shift[1:])])
    axis = np.array([1.0, 0.0, 0.0])
    bare = Jaw(point, axis, angle, np.zeros(len(rest)), np.zeros_like(rest))
    opened = rest + shape
    weight = _weights(bare, rest, opened)
    weight = 0.5 * (weight + weight[bust.mirror])
    resolve_throat_folds(
        bust.quads, rest, float(rest[lip_rings(bust), 1].min()), axis, weight * angle, opened
    )
    corrective = opened - bare.turn(rest, weight * angle)
    return Jaw(point, axis, angle, weight, corrective)


def _weights(jaw: Jaw, rest: AnyArray, opened: AnyArray) -> AnyArray:
    """Share of the full angle (N0,) 0..1 that best carries each vertex, by projection, refined once."""
    weight = np.zeros(len(rest))
    for _ in range(4):
        here = jaw.turn(rest, weight * jaw.angle)
        tangent = np.cross(jaw.axis, here - jaw.point) * jaw.angle
        step = ((opened - here) * tangent).sum(axis=1) / np.maximum((tangent**2).sum(axis=1), 1.0)
        weight = np.clip(weight + step, 0.0, 1.0)
    return np.where(weight < 1e-3, 0.0, weight)


def _rigid(before: AnyArray, after: AnyArray) -> tuple[AnyArray, AnyArray]:
    """Rotation and shift that carry `before` to `after` best (Kabsch)."""
    a, b = before.mean(axis=0), after.mean(axis=0)
    u, _, vt = np.linalg.svd((before - a).T @ (after - b))
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(vt.T @ u.T))])
    rotation = vt.T @ flip @ u.T
    return rotation, b - rotation @ a
