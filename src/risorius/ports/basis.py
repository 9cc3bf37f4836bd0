"""A clip's own basis: the few shapes that its frames are made of, found frame by frame."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray

TOLERANCE = 0.3  # mm by which a vertex may be off before the basis grows
MOST = 40
ROOM = 160  # shapes gathered before the least of them are dropped


@dataclass
class ClipBasis:
    """Shapes that span what was shown of `points` (n, 3), within `tolerance` mm, `most` at most.

    A frame that the shapes so far do not make joins them, less what they make of it (Gram-Schmidt); so one
    pass is enough and memory does not grow with the clip. At the end the shapes are turned to their
    principal axes.
    """

    rest: Array
    tolerance: float = TOLERANCE
    most: int = MOST
    _shapes: Float32Array = field(init=False)
    _count: int = 0
    _weights: list[Float32Array] = field(default_factory=list)
    _errors: list[tuple[float, float]] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._shapes = np.zeros((ROOM, self.rest.size), np.float32)

    def show(self, points: FloatArray) -> None:
        """Take in the next frame, points (n, 3) in mm."""
        weights, rest = self._split((points - self.rest).ravel().astype(np.float32))
        if _distances(rest).max() > self.tolerance and self._count < ROOM:
            # Twice, because the first time leaves a little of the others in it.
            direction = self._split(rest)[1]
            self._shapes[self._count] = direction / np.linalg.norm(direction)
            self._count += 1
            more, rest = self._split(rest)
            weights = np.append(weights, np.float32(0.0)) + more
        self._weights.append(weights)
        distance = _distances(rest)
        self._errors.append((float((distance**2).mean()), float(distance.max())))

    def finish(self) -> tuple[Array, Array]:
        """Return shapes (k, n, 3) mm and weights (frames, k) of about unit size, the largest first."""
        count = self._count
        weights = np.zeros((len(self._weights), count))
        for row, frame_weights in zip(weights, self._weights, strict=True):
            row[: len(frame_weights)] = frame_weights
        if not count:
            return np.zeros((0, *self.rest.shape)), weights
        turn = np.linalg.svd(weights, full_matrices=False)[2]
        turned, shapes = weights @ turn.T, turn @ self._shapes[:count].astype(np.float64)
        self._drop(turned[:, self.most :], shapes[self.most :])
        turned, shapes = turned[:, : self.most], shapes[: self.most]
        scale = np.maximum(np.abs(turned).max(axis=0), 1e-9)
        return (shapes * scale[:, None]).reshape(len(shapes), *self.rest.shape), turned / scale

    def _drop(self, weights: Array, shapes: Array) -> None:
        """Count what shapes that are left out leave over: its distances add to those there were at most."""
        if not len(shapes):
            return
        for k, row in enumerate(weights):
            distance = _distances((row @ shapes).astype(np.float32))
            mean, worst = self._errors[k]
            self._errors[k] = (mean + float((distance**2).mean()), worst + float(distance.max()))

    @property
    def residual(self) -> tuple[float, float]:
        """After `finish`: root mean square and worst distance in mm of the frames from what shapes make."""
        errors = np.array(self._errors)
        return float(np.sqrt(errors[:, 0].mean())), float(errors[:, 1].max())

    def _split(self, rest: Float32Array) -> tuple[Float32Array, Float32Array]:
        """Return the weights of the shapes so far, and what they leave over."""
        shapes = self._shapes[: self._count]
        weights = shapes @ rest
        return weights, np.asarray(rest - weights @ shapes, np.float32)


def _distances(rest: Float32Array) -> Float32Array:
    return np.asarray(np.linalg.norm(rest.reshape(-1, 3), axis=1))
