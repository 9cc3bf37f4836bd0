"""A clip's own basis: the few shapes that its frames are made of, found frame by frame.

Weights of shapes are 0 to 1 in what others read: Blender and engines cut them off there.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ...core.arrays import Array, Float32Array, FloatArray, IndexArray
from ...machine.kernels.jit import kernel

TOLERANCE = 0.3  # mm by which a vertex may be off before the basis grows
MOST = 40
ROOM = 256  # shapes gathered before the least of them are dropped: half a minute with an emotion needs 210
BLOCK = 32  # frames that are compared with the shapes at once: the shapes are read from memory once for all


@dataclass
class ClipBasis:
    """Shapes that span the frames shown of `points` (n, 3), within `tolerance` mm, `most` at most.

    `importance` (n,) is by how much less than `tolerance` each point may be off (None: all alike).
    A frame that the shapes so far do not make joins them, less what they make of it (Gram-Schmidt); so one
    pass is enough and memory does not grow with the clip. At the end the shapes are turned to their
    principal axes. Of all points only those that have moved are compared.
    """

    rest: Array
    tolerance: float = TOLERANCE
    most: int = MOST
    importance: Array | None = None
    _start: Float32Array = field(init=False)
    _columns: IndexArray = field(init=False)
    _shapes: Float32Array = field(init=False)
    _scale: Array = field(init=False)
    _important: IndexArray = field(init=False)
    _factors: Float32Array = field(init=False)
    _count: int = 0
    _block: Float32Array = field(init=False)
    _waiting: int = 0
    _weights: list[Float32Array] = field(default_factory=list)
    _errors: list[Array] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._start = self.rest.astype(np.float32)
        self._columns, self._shapes = np.zeros(0, np.intp), np.zeros((ROOM, 0), np.float32)
        self._block = np.empty((BLOCK, self.rest.size), np.float32)
        self._scale = np.ones(len(self.rest)) if self.importance is None else self.importance
        self._important = np.flatnonzero(np.repeat(self._scale != 1.0, 3))
        self._factors = np.repeat(self._scale, 3)[self._important].astype(np.float32)

    def show(self, points: FloatArray) -> None:
        """Take in the next frame, points (n, 3) in mm."""
        np.subtract(
            points, self._start, out=self._block[self._waiting].reshape(points.shape), casting="same_kind"
        )
        self._waiting += 1
        if self._waiting == BLOCK:
            self._take_in()

    def _take_in(self) -> None:
        """Find the weights of the frames that wait; those that shapes do not make add one each."""
        if not self._waiting:
            return
        block = self._block[: self._waiting]
        block[:, self._important] *= self._factors
        rest = self._of_moving(block)
        self._waiting = 0
        weights = np.zeros((len(rest), ROOM), np.float32)
        self._split(rest, weights)
        for frame in range(len(rest)):
            if self._count == ROOM:
                break
            if _distances(rest[frame : frame + 1]).max(initial=0.0) <= self.tolerance:
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
        self._errors.append(self._errors_of(rest))

    def _of_moving(self, block: Float32Array) -> Float32Array:
        """Return displacements (k, 3 n) of the points that move, in this block or before: (k, 3 m)."""
        moves = np.bitwise_or.reduce(block.view(np.uint32), axis=0).reshape(-1, 3).any(axis=1)
        if self._columns.size:
            moves[self._columns[::3] // 3] = True
        columns = np.flatnonzero(np.repeat(moves, 3))
        if len(columns) > len(self._columns):
            shapes = np.zeros((ROOM, len(columns)), np.float32)
            shapes[:, np.searchsorted(columns, self._columns)] = self._shapes
            self._columns, self._shapes = columns, shapes
        return block.take(columns, axis=1)

    def finish(self) -> tuple[Array, Array]:
        """Return shapes (k, n, 3) mm and weights (frames, k) of about unit size, the largest first."""
        self._take_in()
        count = self._count
        weights = np.array(self._weights, np.float64).reshape(-1, ROOM)[:, :count]
        if not count:
            return np.zeros((0, *self.rest.shape)), weights
        turn = np.linalg.svd(weights, full_matrices=False)[2]
        turned, found = weights @ turn.T, self._shapes[:count]
        self._drop(turned[:, self.most :], turn[self.most :].astype(np.float32) @ found)
        turned, turn = turned[:, : self.most], turn[: self.most]
        scale = np.maximum(np.abs(turned).max(axis=0), 1e-9)
        shapes = np.zeros((len(turn), self.rest.size))
        shapes[:, self._columns] = (turn * scale[:, None]) @ found.astype(np.float64)
        shapes[:, self._important] /= self._factors
        return shapes.reshape(len(turn), *self.rest.shape), turned / scale

    def _drop(self, weights: Array, shapes: Float32Array) -> None:
        """Count the rest that omitted shapes leave: its distances add to the largest ones so far."""
        if not len(shapes):
            return
        for number, errors in enumerate(self._errors):
            block = weights[number * BLOCK : number * BLOCK + len(errors)].astype(np.float32)
            errors += self._errors_of(block @ shapes)

    def _errors_of(self, rest: Float32Array) -> Array:
        """Return the mean square over all points and the largest distance in each frame, (k, 2)."""
        distances = _distances(rest)
        distances /= self._scale[self._columns[::3] // 3]
        squares = (distances**2).sum(axis=1) / len(self.rest)
        return np.stack([squares, distances.max(axis=1, initial=0.0)], axis=1)

    @property
    def residual(self) -> tuple[float, float]:
        """After `finish`: root mean square and worst distance in mm of the frames from the sums of shapes."""
        errors = np.concatenate(self._errors)
        return float(np.sqrt(errors[:, 0].mean())), float(errors[:, 1].max())

    def _split(self, rest: Float32Array, weights: Float32Array) -> None:
        """Take the part of the shapes so far out of some frames `rest` (k, 3 n), and add their weights."""
        shapes = self._shapes[: self._count]
        made = rest @ shapes.T
        weights[:, : self._count] += made
        rest -= made @ shapes


def nonnegative(shapes: Array, weights: Array) -> tuple[Array, Array]:
    """Return shapes (k + 1, n, 3) and weights (frames, k + 1) 0..1 that make what the given ones make.

    The last shape is minus the sum of the others: it takes back what makes their weights positive.
    """
    if not len(shapes):
        return shapes, weights
    taken_back = np.maximum(-weights.min(axis=1, keepdims=True), 0.0)
    raised = np.concatenate([weights + taken_back, taken_back], axis=1)
    scale = max(float(raised.max()), 1e-9)
    scaled = shapes * scale
    return np.concatenate([scaled, -scaled.sum(axis=0, keepdims=True)]), raised / scale


def _distances(rest: Float32Array) -> Float32Array:
    """Return how far each vertex is off in each frame, (k, n)."""
    squares = np.empty((len(rest), rest.shape[1] // 3), np.float32)
    _squares(rest, squares)
    return np.sqrt(squares, out=squares)


@kernel("f4[:, :], f4[:, :]")
def _squares(rest: Float32Array, out: Float32Array) -> None:
    for f in range(len(out)):
        for v in range(out.shape[1]):
            x, y, z = rest[f, 3 * v], rest[f, 3 * v + 1], rest[f, 3 * v + 2]
            out[f, v] = x * x + y * y + z * z
