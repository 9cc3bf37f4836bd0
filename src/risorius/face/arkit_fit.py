"""ARKit weights of a face: the non-negative least squares of its skin over the head's 52 sculpted shapes.

The eyes' shapes stand for the eyes' rotation and `tongueOut` for the tongue, so these are not fitted: weight
1 is the farthest that the table of parameters allows. `mouthClose` closes what `jawOpen` opens, so it is
never more than it: the two are fitted as an opening, and an opening with the lips together. Of shapes that
exclude each other the difference stays, and the others are fitted anew, vertices that are far off held back.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from ..core.arkit import EXCLUSIVE, INDEX, OPPOSED, SHAPES
from ..core.arrays import Array, BoolArray, FloatArray
from ..core.parameters import INDEX as PARAMETER
from .arkit_given import GIVEN, given_weights
from .eyes import pitch_and_yaw
from .far_vertices import FarVertices
from .frame import FaceFrame
from .head import Head
from .lids import FRONT, LID_REACH
from .shapes import ArkitShapes, arkit_shapes

# Shares of the mean square of a shape: what keeps nearly parallel shapes, and opposed ones, from fighting.
RIDGE, AGAINST = 3e-5, 5e-5
LIPS = 2.0  # how much more the lips count: they are few vertices, and what is looked at
HIDDEN = 3.0  # mm before the eyeball's front plane up to which the socket's lining is not seen
MOVED = 0.3  # mm by which some shape must move a vertex for it to count in the residual

_JAW, _CLOSE = INDEX["jawOpen"], INDEX["mouthClose"]
_EXCLUSIVE = np.array([[INDEX[name] for name in pair] for pair in EXCLUSIVE])


@dataclass(frozen=True, slots=True, eq=False)
class ArkitTrack:
    """A performance in ARKit's terms, frame by frame.

    weights  (frames, 52) 0..1 in the order of `core.arkit.SHAPES`
    head     (frames, 3) yaw, pitch, roll of the head in degrees: to the subject's left, up, tilted left
    eyes     (frames, 2, 3) the same of the left and the right eye in the head; no roll
    rms      (frames,) mm between the skin that the weights make and the face, where shapes move it
    worst    (frames,) mm of the vertex that fits least
    """

    weights: Array
    head: Array
    eyes: Array
    rms: Array
    worst: Array

    @property
    def rotations(self) -> Array:
        """Yaw, pitch and roll of head, left and right eye (frames, 9) in radians."""
        angles = np.concatenate([self.head[:, None], self.eyes], axis=1)
        return np.asarray(np.radians(angles).reshape(len(angles), -1))

    @property
    def residual(self) -> tuple[float, float]:
        """The root mean square over all frames and the worst vertex, in mm."""
        return float(np.sqrt((self.rms**2).mean())), float(self.worst.max())


class ArkitFit:
    """Fits frames of one head by the shapes `available` (all where None); the others get 0.

    Raises HeadError where the head has no sculpted shapes.
    """

    def __init__(self, head: Head, available: Collection[str] | None = None) -> None:
        self._free, self._given = _roles(SHAPES if available is None else available)
        self.shapes: ArkitShapes = arkit_shapes(head)
        self.rest: Array = head.skin.matrix @ head.rest
        dense = self.shapes.skin.toarray()
        size = np.linalg.norm(dense.reshape(len(SHAPES), -1, 3), axis=2).max(axis=0)
        self.counted = np.flatnonzero(_seen(head, self.rest) & (size > MOVED))
        columns = (3 * self.counted[:, None] + np.arange(3)).ravel()
        self._basis = np.ascontiguousarray(dense[:, columns])
        self._fitted = self._basis.copy()
        self._fitted[_CLOSE] += self._fitted[_JAW]
        lips = head.skin.matrix @ head.masks["lips"]
        self._heavy = self._fitted * np.repeat(1.0 + LIPS * lips[self.counted], 3)
        self._normal = _regular(self._heavy @ self._fitted.T)

    def weights(self, frame: FaceFrame) -> Array:
        """Return the weights (52,) of a frame, 0..1."""
        return self._solve(self.displacement(frame.skin), given_weights(frame))

    def of_skin(self, skin: FloatArray, given: Array | None = None) -> Array:
        """Return the weights (52,) of a level-1 skin (N1, 3) mm; `given` (52,) are those not fitted."""
        return self._solve(self.displacement(skin), np.zeros(len(SHAPES)) if given is None else given)

    def skin(self, weights: Array) -> Array:
        """Return the level-1 skin (N1, 3) in mm that `weights` (52,) make."""
        return np.asarray(self.rest + (weights @ self.shapes.skin).reshape(-1, 3))

    def residual(self, frame: FaceFrame, weights: Array) -> tuple[float, float]:
        """Return the root mean square and the greatest distance in mm between a frame and its weights' skin.

        Over the vertices that are seen and that some shape moves.
        """
        rest = self.displacement(frame.skin) - weights @ self._basis
        distance = np.linalg.norm(rest.reshape(-1, 3), axis=1)
        return float(np.sqrt((distance**2).mean())), float(distance.max())

    def track(self, frames: Iterable[FaceFrame]) -> ArkitTrack:
        """Fit all frames in order."""
        rows = [self._row(frame) for frame in frames]
        weights, head, eyes, errors = (np.array(part) for part in zip(*rows, strict=True))
        return ArkitTrack(weights, head, eyes, errors[:, 0], errors[:, 1])

    def _row(self, frame: FaceFrame) -> tuple[Array, Array, Array, tuple[float, float]]:
        weights = self.weights(frame)
        eyes = np.array([(yaw, pitch, 0.0) for pitch, yaw in map(pitch_and_yaw, frame.eye_rotation)])
        head = frame.parameters[[PARAMETER[f"head_{axis}"] for axis in ("yaw", "pitch", "roll")]]
        return weights, head, eyes, self.residual(frame, weights)

    def seen_displacement(self, weights: Array) -> Array:
        """Return the displacements (frames, 3 k) in mm that `weights` (frames, 52) make of what is seen."""
        return np.asarray(weights @ self._basis)

    def displacement(self, skin: FloatArray) -> Array:
        """Return the displacement (3 k,) in mm of what is seen of a level-1 skin (N1, 3)."""
        return np.asarray((skin[self.counted] - self.rest[self.counted]).ravel(), dtype=np.float64)

    def _solve(self, displacement: Array, given: Array) -> Array:
        given = given * self._given
        wanted = displacement - given @ self._basis
        right = self._heavy @ wanted
        both = self._least(self._normal, right, np.full(len(SHAPES), np.nan))
        kept = _one_of_each(both)
        start = self._least(self._normal, right, kept)
        held = FarVertices(self._fitted, wanted, self._normal, right)
        weights = held.settle(start, lambda normal, right: self._least(normal, right, kept)) + given
        weights[_JAW] += weights[_CLOSE]
        weights = np.minimum(weights, 1.0)
        weights[_CLOSE] = min(weights[_CLOSE], weights[_JAW])
        return weights

    def _least(self, normal: Array, right: Array, kept: Array) -> Array:
        """Return the non-negative least squares (52,) of normal equations; those `kept` are not NaN."""
        fixed = ~np.isnan(kept)
        free = self._free & ~fixed
        weights = np.where(fixed, kept, 0.0)
        if not free.any():
            return weights
        factor = np.linalg.cholesky(normal[np.ix_(free, free)])
        rest = right[free] - normal[np.ix_(free, fixed)] @ weights[fixed]
        weights[free] = nnls(factor.T, np.linalg.solve(factor, rest))[0]
        return weights


def _one_of_each(weights: Array) -> Array:
    """Return (52,) what is left of shapes that exclude each other, one of them 0, and NaN for all others.

    The difference of the two, because it passes through 0 without a jump.
    """
    kept = np.full(len(SHAPES), np.nan)
    one, other = _EXCLUSIVE.T
    left = weights[one] - weights[other]
    kept[one], kept[other] = np.maximum(left, 0.0), np.maximum(-left, 0.0)
    return kept


def _roles(available: Collection[str]) -> tuple[BoolArray, BoolArray]:
    """Return which shapes (52,) are fitted and which are given, of those that are available."""
    there = np.array([name in available for name in SHAPES])
    there[_CLOSE] &= there[_JAW]  # what closes an opening is nothing without it
    return there & ~GIVEN, there & GIVEN


def _seen(head: Head, rest: Array) -> BoolArray:
    """Return which vertices (N1,) can be seen: not those inside the mouth or behind the lids."""
    seen = np.asarray(head.skin.matrix @ head.masks["inner_mouth"] < 0.5)
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        place = rest - centre
        near = np.linalg.norm(place, axis=1) < radius + LID_REACH
        seen &= ~(near & (place[:, 2] < FRONT * radius + HIDDEN))
    return seen


def _regular(normal: Array) -> Array:
    """Return normal equations (52, 52) held by the ridge and between opposed shapes."""
    scale = np.trace(normal) / len(normal)
    result = normal + RIDGE * scale * np.eye(len(normal))
    for pair in OPPOSED:
        rows = [INDEX[name] for name in pair]
        result[np.ix_(rows, rows)] += AGAINST * scale
    return np.asarray(result)
