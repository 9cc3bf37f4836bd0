"""ARKit weights of a face: the non-negative least squares of its skin over the head's 52 sculpted shapes.

The eyes' shapes follow from the eyes' rotation and `tongueOut` from the tongue, so these are not fitted:
weight 1 is the farthest that the table of parameters allows. `mouthClose` closes what `jawOpen` opens and is
never larger: the two are fitted as an opening, and as an opening with the lips together. Of shapes that
exclude each other only the difference remains; then the others are fitted again, with a penalty for vertices
that are far off.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.optimize import nnls

from ..core.arkit import EXCLUSIVE, INDEX, OPPOSED, SHAPES
from ..core.arrays import Array, BoolArray, FloatArray
from ..core.blas import one_thread
from ..core.parameters import INDEX as PARAMETER
from .arkit_direct import DIRECT, direct_weights
from .eyes import pitch_and_yaw
from .far_vertices import FarVertices
from .frame import FaceFrame
from .head import Head
from .lids import FRONT, LID_REACH
from .shapes import ArkitShapes, arkit_shapes

# Shares of the mean square of a shape that keep nearly parallel and opposed shapes from cancelling each
# other.
RIDGE, AGAINST = 3e-5, 5e-5
LIPS = 2.0  # how much more the lips count: they have few vertices, and people look at them
HIDDEN = 3.0  # mm before the eyeball's front plane; behind that, the socket's lining is not visible
MOVED = 0.3  # mm: a vertex counts in the residual if some shape moves it farther

_JAW, _CLOSE = INDEX["jawOpen"], INDEX["mouthClose"]
_EXCLUSIVE = np.array([[INDEX[name] for name in pair] for pair in EXCLUSIVE])


@dataclass(frozen=True, slots=True, eq=False)
class ArkitTrack:
    """A performance in ARKit's terms, frame by frame.

    weights  (frames, 52) 0..1 in the order of `core.arkit.SHAPES`
    head     (frames, 3) yaw, pitch, roll of the head in degrees: to the subject's left, up, tilted left
    eyes     (frames, 2, 3) the same of the left and the right eye in the head; no roll
    rms      (frames,) mm between the weights' skin and the face, over the vertices that shapes move
    worst    (frames,) mm of the vertex that fits worst
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
    """Fits frames of one head by the shapes `available` (None: all); the others get 0.

    Raises HeadError if the head has no sculpted shapes.
    """

    def __init__(self, head: Head, available: Collection[str] | None = None) -> None:
        self._free, self._direct = _roles(SHAPES if available is None else available)
        self.shapes: ArkitShapes = arkit_shapes(head)
        self.rest: Array = head.skin.matrix @ head.rest
        dense = self.shapes.skin.toarray()
        size = np.linalg.norm(dense.reshape(len(SHAPES), -1, 3), axis=2).max(axis=0)
        self.counted = np.flatnonzero(_visible(head, self.rest) & (size > MOVED))
        columns = (3 * self.counted[:, None] + np.arange(3)).ravel()
        self._basis = np.ascontiguousarray(dense[:, columns])
        self._fitted = self._basis.copy()
        self._fitted[_CLOSE] += self._fitted[_JAW]
        lips = head.skin.matrix @ head.masks["lips"]
        self._heavy = self._fitted * np.repeat(1.0 + LIPS * lips[self.counted], 3)
        self._normal = _regular(self._heavy @ self._fitted.T)

    @classmethod
    @lru_cache(maxsize=2)
    def of(cls, head: Head) -> ArkitFit:
        """Return the fit by all shapes of `head`, which is the same for the same head."""
        return cls(head)

    def weights(self, frame: FaceFrame) -> Array:
        """Return the weights (52,) of a frame, 0..1."""
        return self._solve(self.displacement(frame.skin), direct_weights(frame))

    def of_skin(self, skin: FloatArray, direct: Array | None = None) -> Array:
        """Return the weights (52,) of a level-1 skin (N1, 3) mm; `direct` (52,) are weights without a fit."""
        return self._solve(self.displacement(skin), np.zeros(len(SHAPES)) if direct is None else direct)

    def skin(self, weights: Array) -> Array:
        """Return the level-1 skin (N1, 3) in mm of `weights` (52,)."""
        return np.asarray(self.rest + (weights @ self.shapes.skin).reshape(-1, 3))

    def residual(self, frame: FaceFrame, weights: Array) -> tuple[float, float]:
        """Return the root mean square and the greatest distance in mm between a frame and its weights' skin.

        Both are over the visible vertices that some shape moves.
        """
        rest = self.displacement(frame.skin) - weights @ self._basis
        distance = np.linalg.norm(rest.reshape(-1, 3), axis=1)
        return float(np.sqrt((distance**2).mean())), float(distance.max())

    def track(self, frames: Iterable[FaceFrame]) -> ArkitTrack:
        """Fit all frames in order."""
        with one_thread():
            rows = [self._row(frame) for frame in frames]
        weights, head, eyes, errors = (np.array(part) for part in zip(*rows, strict=True))
        return ArkitTrack(weights, head, eyes, errors[:, 0], errors[:, 1])

    def _row(self, frame: FaceFrame) -> tuple[Array, Array, Array, tuple[float, float]]:
        weights = self.weights(frame)
        eyes = np.array([(yaw, pitch, 0.0) for pitch, yaw in map(pitch_and_yaw, frame.eye_rotation)])
        head = frame.parameters[[PARAMETER[f"head_{axis}"] for axis in ("yaw", "pitch", "roll")]]
        return weights, head, eyes, self.residual(frame, weights)

    def visible_displacement(self, weights: Array) -> Array:
        """Return the displacements (frames, 3 k) in mm of the visible vertices by `weights` (frames, 52)."""
        return np.asarray(weights @ self._basis)

    def displacement(self, skin: FloatArray) -> Array:
        """Return the displacement (3 k,) in mm of the visible vertices of a level-1 skin (N1, 3)."""
        return np.asarray((skin[self.counted] - self.rest[self.counted]).ravel(), dtype=np.float64)

    def _solve(self, displacement: Array, direct: Array) -> Array:
        direct = direct * self._direct
        wanted = displacement - direct @ self._basis
        right = self._heavy @ wanted
        both = self._least(self._normal, right, np.full(len(SHAPES), np.nan))
        fixed_weights = _one_of_each(both)
        start = self._least(self._normal, right, fixed_weights)
        far = FarVertices(self._fitted, wanted, self._normal, right)
        weights = (
            far.solution(start, lambda normal, right: self._least(normal, right, fixed_weights)) + direct
        )
        weights[_JAW] += weights[_CLOSE]
        weights = np.minimum(weights, 1.0)
        weights[_CLOSE] = min(weights[_CLOSE], weights[_JAW])
        return weights

    def _least(self, normal: Array, right: Array, fixed_weights: Array) -> Array:
        """Return the non-negative least squares (52,) of normal equations.

        `fixed_weights` (52,): NaN for the weights that are free.
        """
        fixed = ~np.isnan(fixed_weights)
        free = self._free & ~fixed
        weights = np.where(fixed, fixed_weights, 0.0)
        if not free.any():
            return weights
        factor = np.linalg.cholesky(normal[np.ix_(free, free)])
        rest = right[free] - normal[np.ix_(free, fixed)] @ weights[fixed]
        weights[free] = nnls(factor.T, np.linalg.solve(factor, rest))[0]
        return weights


def _one_of_each(weights: Array) -> Array:
    """Return the weights (52,) of shapes that exclude each other, NaN for all others.

    One of the two is 0, the other their difference, because that passes through 0 without a jump.
    """
    fixed_weights = np.full(len(SHAPES), np.nan)
    one, other = _EXCLUSIVE.T
    difference = weights[one] - weights[other]
    fixed_weights[one], fixed_weights[other] = np.maximum(difference, 0.0), np.maximum(-difference, 0.0)
    return fixed_weights


def _roles(available: Collection[str]) -> tuple[BoolArray, BoolArray]:
    """Return which of the available shapes (52,) are fitted, and which follow directly from the frame."""
    usable = np.array([name in available for name in SHAPES])
    usable[_CLOSE] &= usable[_JAW]  # without the opening there is nothing to close
    return usable & ~DIRECT, usable & DIRECT


def _visible(head: Head, rest: Array) -> BoolArray:
    """Return which vertices (N1,) are visible: not those inside the mouth or behind the lids."""
    seen = np.asarray(head.skin.matrix @ head.masks["inner_mouth"] < 0.5)
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        place = rest - centre
        near = np.linalg.norm(place, axis=1) < radius + LID_REACH
        seen &= ~(near & (place[:, 2] < FRONT * radius + HIDDEN))
    return seen


def _regular(normal: Array) -> Array:
    """Return normal equations (52, 52) with the ridge, and the penalty for opposed shapes together."""
    scale = np.trace(normal) / len(normal)
    result = normal + RIDGE * scale * np.eye(len(normal))
    for pair in OPPOSED:
        rows = [INDEX[name] for name in pair]
        result[np.ix_(rows, rows)] += AGAINST * scale
    return np.asarray(result)
