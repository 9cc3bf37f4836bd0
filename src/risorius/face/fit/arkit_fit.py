"""ARKit weights of a face: the non-negative least squares of its skin over the head's 52 sculpted shapes.

The eyes' shapes follow from the eyes' rotation and `tongueOut` from the tongue, so these are not fitted:
weight 1 is the farthest that the table of parameters allows. `mouthClose` closes what `jawOpen` opens and is
never larger: the two are fitted as an opening, and as an opening with the lips together. Of shapes that
exclude each other only the difference remains; then the others are fitted again, with a penalty for vertices
that are far off.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from functools import lru_cache
from itertools import islice
from typing import NamedTuple

import numpy as np

from ...core.arkit import EXCLUSIVE, INDEX, OPPOSED, SHAPES
from ...core.arrays import Array, BoolArray, FloatArray, IntArray
from ...core.parameters import INDEX as PARAMETER
from ...machine.blas import one_thread
from ..contact.lids import FRONT, LID_REACH
from ..frame import FaceFrame
from ..head.eyes import pitch_and_yaw
from ..head.head import Head
from ..numerics.nonnegative import least_squares
from ..numerics.robust_fit import FAR, RobustFit, lengths, within_leeway
from .arkit_direct import DIRECT, direct_weights
from .arkit_track import ArkitTrack
from .contact_limits import ContactLimits
from .shapes import ArkitShapes, arkit_shapes

# Shares of the mean square of a shape that keep nearly parallel and opposed shapes from cancelling each
# other.
RIDGE, AGAINST = 3e-5, 5e-5
LIPS = 2.0  # how much more the lips count: they have few vertices, and people look at them
HIDDEN = 3.0  # mm before the eyeball's front plane; behind that, the socket's lining is not visible
NEARLY = 1.0  # mm below the distance from which a vertex is far: such vertices may become far
BLOCK = 64  # frames that are fitted together: the shapes are read from memory once for all of them
MOVED = 0.3  # mm: a vertex counts in the residual if some shape moves it farther

NO_WAY = np.zeros(len(SHAPES))
_JAW, _CLOSE = INDEX["jawOpen"], INDEX["mouthClose"]
_EXCLUSIVE = np.array([[INDEX[name] for name in pair] for pair in EXCLUSIVE])


class ArkitFit:
    """Fits frames of one head by the shapes `available` (None: all); the others get 0.

    Raises HeadError if the head has no sculpted shapes.
    """

    def __init__(self, head: Head, available: Collection[str] | None = None) -> None:
        self._free, self._direct = _roles(SHAPES if available is None else available)
        self.shapes: ArkitShapes = arkit_shapes(head)
        self.rest: Array = head.skin.matrix @ head.rest
        skin, own = self.shapes.skin[:, : 3 * len(head.rest)], len(head.rest)
        moved = [np.linalg.norm(row.toarray().reshape(-1, 3), axis=1) > MOVED for row in skin]
        self.counted = np.flatnonzero(_visible(head, self.rest)[:own] & np.any(moved, axis=0))
        columns = (3 * self.counted[:, None] + np.arange(3)).ravel()
        self._basis = skin[:, columns].toarray()
        self._fitted = self._basis.copy()
        self._fitted[_CLOSE] += self._fitted[_JAW]
        lips = head.skin.matrix @ head.masks["lips"]
        heavy = self._fitted * np.repeat(1.0 + LIPS * lips[self.counted], 3)
        self._heavy = np.ascontiguousarray(heavy.T)
        self._products = self._fitted @ self._heavy
        self._rest_seen = self.rest[self.counted]
        normal = _regular(self._products)
        alone = np.ones(len(SHAPES), dtype=bool)
        alone[_EXCLUSIVE.ravel()] = False
        self._contact = ContactLimits(head, self.rest, self._moved, normal, self._free)
        self._all = _Normal.of(normal, self._free)
        self._some = _Normal.of(normal, self._free & alone)
        moves = self._fitted.reshape(len(SHAPES), -1, 3)[self._some.free]
        self._moves = np.ascontiguousarray(moves.transpose(1, 2, 0))

    def _moved(self, vertices: IntArray) -> Array:
        """Return how far the unknowns of the fit displace some vertices (k,): (52, k, 3) mm at 1."""
        columns = (3 * vertices[:, None] + np.arange(3)).ravel()
        moved = self.shapes.skin[:, columns].toarray()
        moved[_CLOSE] += moved[_JAW]
        return np.asarray(moved.reshape(len(SHAPES), -1, 3))

    @classmethod
    @lru_cache(maxsize=2)
    def of(cls, head: Head) -> ArkitFit:
        """Return the fit by all shapes of `head`, which is the same for the same head."""
        return cls(head)

    def weights(self, frame: FaceFrame) -> Array:
        """Return the weights (52,) of a frame, 0..1."""
        return self.of_skin(frame.skin, direct_weights(frame))

    def of_skin(self, skin: FloatArray, direct: Array | None = None) -> Array:
        """Return the weights (52,) of a level-1 skin (N1, 3) mm; `direct` (52,) are weights without a fit."""
        given = np.zeros(len(SHAPES)) if direct is None else direct
        return np.asarray(self._alone(skin, given, NO_WAY).weights[0])

    def following(self, frame: FaceFrame, way: Array = NO_WAY) -> tuple[Array, Array]:
        """Return the weights (52,) of a frame alone, for those that wait for it, but for rounding.

        `way` (52,) is what this returned beside them for the frame before; it shortens the search.
        """
        found = self._alone(frame.skin, direct_weights(frame), way)
        return np.asarray(found.weights[0]), found.way

    def _alone(self, skin: FloatArray, direct: Array, way: Array) -> _Solution:
        """Return the weights of one level-1 skin (N1, 3) mm; `direct` (52,), `way` (52,) as in `_solve`."""
        return self._solve(self.displacement(skin)[None], self._contact.points(skin)[None], direct[None], way)

    def skin(self, weights: Array) -> Array:
        """Return the level-1 skin (N1, 3) in mm of `weights` (52,)."""
        return np.asarray(self.rest + (weights @ self.shapes.skin).reshape(-1, 3))

    def residual(self, frame: FaceFrame, weights: Array) -> tuple[float, float]:
        """Return the root mean square and the greatest distance in mm between a frame and its weights' skin.

        Both are over the visible vertices that some shape moves.
        """
        rms, worst = _residual((self.displacement(frame.skin) - weights @ self._basis)[None])
        return float(rms[0]), float(worst[0])

    def track(self, frames: Iterable[FaceFrame]) -> ArkitTrack:
        """Fit all frames in order."""
        blocks, way, rest = [], NO_WAY, iter(frames)
        displacement = np.zeros((BLOCK, self._basis.shape[1]))
        with one_thread():
            while (block := self._block(islice(rest, BLOCK), displacement, way)) is not None:
                part, way = block
                blocks.append(part)
        weights, rotations, parameters, rms, worst = (
            np.concatenate(part) for part in zip(*blocks, strict=True)
        )
        head = parameters[:, [PARAMETER[f"head_{axis}"] for axis in ("yaw", "pitch", "roll")]]
        eyes = [[(yaw, pitch, 0.0) for pitch, yaw in map(pitch_and_yaw, pair)] for pair in rotations]
        return ArkitTrack(weights, head, np.array(eyes), rms, worst)

    def _block(
        self, frames: Iterable[FaceFrame], displacement: Array, way: Array
    ) -> tuple[tuple[Array, Array, Array, Array, Array], Array] | None:
        """Return weights, eyes' rotations, parameters and residuals of up to `BLOCK` frames; or None.

        `displacement` (`BLOCK`, 3 k) is scratch. `way` (52,): how the penalty changed the frame before;
        returned is the last frame's.
        """
        seen, touching = [], []
        for row, frame in zip(displacement, frames, strict=False):
            row[:] = self.displacement(frame.skin)
            touching.append(self._contact.points(frame.skin))
            seen.append((direct_weights(frame), frame.eye_rotation, frame.parameters))
        if not seen:
            return None
        direct, rotations, parameters = map(np.array, zip(*seen, strict=True))
        weights, way = self._solve(displacement, np.array(touching), direct, way)
        rms, worst = _residual(displacement - _rows(weights, BLOCK) @ self._basis)
        return (weights, rotations, parameters, rms[: len(seen)], worst[: len(seen)]), way

    def visible_displacement(self, weights: Array) -> Array:
        """Return the displacements (frames, 3 k) in mm of the visible vertices by `weights` (frames, 52)."""
        return np.asarray(weights @ self._basis)

    def displacement(self, skin: FloatArray) -> Array:
        """Return the displacement (3 k,) in mm of the visible vertices of a level-1 skin (N1, 3)."""
        return np.asarray((skin.take(self.counted, axis=0) - self._rest_seen).ravel(), dtype=np.float64)

    def _solve(self, displacement: Array, touching: Array, direct: Array, way: Array) -> _Solution:
        """Return the weights (n, 52) of the first n of a block of displacements; `direct` (n, 52).

        `touching` (n, k, 3) mm are the vertices of lips and lids that touch. `way` (52,): how the penalty
        changed the weights of the frame before, if there is one.
        """
        direct = direct * self._direct
        size = len(displacement)
        rights = (displacement @ self._heavy)[: len(direct)] - direct @ self._products
        starts = self._starts(rights)
        weights = starts + direct
        left = displacement - _rows(weights, size) @ self._fitted
        apart = _distances(left)
        for k, start in enumerate(starts):
            way = self._way(left[k].reshape(-1, 3), apart[k], rights[k], start, way)
            weights[k] += within_leeway(way)
        self._contact.keep(weights, touching)
        weights[:, _JAW] += weights[:, _CLOSE]
        weights = np.minimum(weights, 1.0)
        weights[:, _CLOSE] = np.minimum(weights[:, _CLOSE], weights[:, _JAW])
        return _Solution(weights, way)

    def _starts(self, rights: Array) -> Array:
        """Return the least squares (n, 52) of which one of two shapes that exclude each other is 0."""
        together = nothing = np.zeros(len(SHAPES))
        result = np.empty_like(rights)
        for k, right in enumerate(rights):
            together = self._all.least(right, nothing, together)
            result[k] = self._some.least(right, _one_of_each(together), together)
        return result

    def _way(self, left: Array, apart: Array, right: Array, start: Array, guess: Array) -> Array:
        """Return how the penalty for far vertices changes the weights `start` (52,) of the least squares.

        `left` (k, 3) and `apart` (k,) mm are what these weights leave, and its lengths. Only the vertices
        that are far or nearly so are looked at, and those that prove to be far in the end. `guess` (52,): of
        the frame before, from which the search begins.
        """
        way, free = np.zeros(len(SHAPES)), self._some.free
        seen = np.zeros(len(apart), dtype=bool)
        right, start = self._some.right(right, start), start[free]
        begin = np.maximum(start + guess[free], 0.0)
        while np.any(apart[~seen] > FAR):
            seen |= apart > FAR - NEARLY
            begin = RobustFit(self._moves[seen], left[seen], self._some.normal, right, start).minimum(begin)
            way[free] = begin - start
            apart = lengths(left - (way @ self._fitted).reshape(-1, 3))
        return way


class _Solution(NamedTuple):
    """The weights (n, 52) of some frames, and how the penalty changed the last one's (52,)."""

    weights: Array
    way: Array


class _Normal(NamedTuple):
    """Normal equations with some shapes `free` (52,): the free shapes' (f, f), and the part of the others."""

    free: BoolArray
    normal: Array
    beside: Array

    @classmethod
    def of(cls, normal: Array, free: BoolArray) -> _Normal:
        """Take equations (52, 52) apart."""
        return cls(free, normal[np.ix_(free, free)], normal[np.ix_(free, ~free)])

    def right(self, right: Array, fixed: Array) -> Array:
        """Return the free shapes' right side (f,), when the others have the weights of `fixed` (52,)."""
        return np.asarray(right[self.free] - self.beside @ fixed[~self.free])

    def least(self, right: Array, fixed: Array, begin: Array) -> Array:
        """Return the non-negative least squares (52,), sought from `begin` (52,); `fixed` as in `right`."""
        weights = fixed.copy()
        weights[self.free] = least_squares(self.normal, self.right(right, fixed), begin[self.free])
        return weights


def _rows(weights: Array, size: int) -> Array:
    """Return weights (n, 52) filled up with zeros to a block: a product's rounding depends on its size."""
    return np.concatenate((weights, np.zeros((size - len(weights), weights.shape[1]))))


def _distances(left: Array) -> Array:
    """Return the lengths of vectors (n, 3 k) -> (n, k)."""
    return lengths(left.reshape(-1, 3)).reshape(len(left), -1)


def _residual(left: Array) -> tuple[Array, Array]:
    """Return the root mean square and the greatest of the distances that are left over (n, 3 k), mm."""
    distance = _distances(left)
    return np.sqrt((distance**2).mean(axis=1)), distance.max(axis=1)


def _one_of_each(weights: Array) -> Array:
    """Return the weights (52,) of shapes that exclude each other, 0 for all others.

    One of the two is 0, the other their difference, because that passes through 0 without a jump.
    """
    fixed_weights = np.zeros(len(SHAPES))
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
