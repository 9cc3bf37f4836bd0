"""A clip's own basis: the few shapes that its frames are made of, found frame by frame."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..core.arrays import Array, Float32Array, FloatArray
from ..core.kernels.jit import lean_kernel

TOLERANCE = 0.3  # mm by which a vertex may be off before the basis grows
MOST = 40
ROOM = 160  # shapes gathered before the least of them are dropped
BLOCK = 32  # frames that are compared with the shapes at once: the shapes are read from memory once for all


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
    _waiting: list[Float32Array] = field(default_factory=list)
    _weights: list[Float32Array] = field(default_factory=list)
    _errors: list[Array] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._shapes = np.zeros((ROOM, self.rest.size), np.float32)

    def show(self, points: FloatArray) -> None:
        """Take in the next frame, points (n, 3) in mm."""
        self._waiting.append((points - self.rest).ravel().astype(np.float32))
        if len(self._waiting) == BLOCK:
            self._take_in()

    def _take_in(self) -> None:
        """Find the weights of the frames that wait; those that shapes do not make add one each."""
        if not self._waiting:
            return
        rest = np.array(self._waiting)
        self._waiting.clear()
        weights = np.zeros((len(rest), ROOM), np.float32)
        self._split(rest, weights)
        for frame in range(len(rest)):
            if self._count == ROOM:
                break
            if _distances(rest[frame : frame + 1]).max() <= self.tolerance:
                continue
            # Once more, because the first time leaves a little of the others in it.
            direction = rest[frame : frame + 1].copy()
            self._split(direction, np.zeros((1, ROOM), np.float32))
            new = direction[0] / np.linalg.norm(direction)
            self._shapes[self._count] = new
            share = rest[frame:] @ new
            weights[frame:, self._count] = share
            rest[frame:] -= share[:, None] * new
            self._count += 1
        self._weights.extend(weights)
        distances = _distances(rest)
        self._errors.append(np.stack([(distances**2).mean(axis=1), distances.max(axis=1)], axis=1))

    def finish(self) -> tuple[Array, Array]:
        """Return shapes (k, n, 3) mm and weights (frames, k) of about unit size, the largest first."""
        self._take_in()
        count = self._count
        weights = np.array(self._weights, np.float64).reshape(-1, ROOM)[:, :count]
        if not count:
            return np.zeros((0, *self.rest.shape)), weights
        turn = np.linalg.svd(weights, full_matrices=False)[2]
        turned, shapes = weights @ turn.T, turn @ self._shapes[:count].astype(np.float64)
        self._drop(turned[:, self.most :], shapes[self.most :].astype(np.float32))
        turned, shapes = turned[:, : self.most], shapes[: self.most]
        scale = np.maximum(np.abs(turned).max(axis=0), 1e-9)
        return (shapes * scale[:, None]).reshape(len(shapes), *self.rest.shape), turned / scale

    def _drop(self, weights: Array, shapes: Float32Array) -> None:
        """Count what shapes that are left out leave over: its distances add to those there were at most."""
        if not len(shapes):
            return
        for number, errors in enumerate(self._errors):
            block = weights[number * BLOCK : number * BLOCK + len(errors)].astype(np.float32)
            distances = _distances(block @ shapes)
            errors[:, 0] += (distances**2).mean(axis=1)
            errors[:, 1] += distances.max(axis=1)

    @property
    def residual(self) -> tuple[float, float]:
        """After `finish`: root mean square and worst distance in mm of the frames from what shapes make."""
        errors = np.concatenate(self._errors)
        return float(np.sqrt(errors[:, 0].mean())), float(errors[:, 1].max())

    def _split(self, rest: Float32Array, weights: Float32Array) -> None:
        """Take what the shapes so far make out of some frames `rest` (k, 3 n), and add their weights."""
        shapes = self._shapes[: self._count]
        made = rest @ shapes.T
        weights[:, : self._count] += made
        rest -= made @ shapes


def _distances(rest: Float32Array) -> Float32Array:
    """Return how far each vertex is off in each frame, (k, n)."""
    squares = np.empty((len(rest), rest.shape[1] // 3), np.float32)
    _squares(rest, squares)
    return np.sqrt(squares, out=squares)


@lean_kernel
def _squares(rest: Float32Array, out: Float32Array) -> None:
    for f in range(len(out)):
        for v in range(out.shape[1]):
            x, y, z = rest[f, 3 * v], rest[f, 3 * v + 1], rest[f, 3 * v + 2]
            out[f, v] = x * x + y * y + z * z
