"""A clip's own basis: the few shapes that its frames are made of, found frame by frame."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Array32 = npt.NDArray[np.float32]

TOLERANCE = 0.3  # mm by which a vertex may be off before the basis grows
MOST = 40


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
    _shapes: list[Array32] = field(default_factory=list)
    _weights: list[Array] = field(default_factory=list)
    _errors: list[tuple[float, float]] = field(default_factory=list)

    def show(self, points: npt.NDArray[np.floating]) -> None:
        """Take in the next frame, points (n, 3) in mm."""
        rest = (points - self.rest).ravel()
        weights, rest = self._split(rest)
        if self._worst(rest) > self.tolerance and len(self._shapes) < self.most:
            size = float(np.linalg.norm(rest))
            self._shapes.append((rest / size).astype(np.float32))
            more, rest = self._split(rest)
            weights = np.append(weights, 0.0) + more
        self._weights.append(weights)
        distance = np.linalg.norm(rest.reshape(-1, 3), axis=1)
        self._errors.append((float((distance**2).mean()), float(distance.max())))

    def finish(self) -> tuple[Array, Array]:
        """Return shapes (k, n, 3) mm and weights (frames, k) of about unit size, the largest first."""
        count = len(self._shapes)
        weights = np.zeros((len(self._weights), count))
        for row, found in zip(weights, self._weights, strict=True):
            row[: len(found)] = found
        if not count:
            return np.zeros((0, *self.rest.shape)), weights
        _, _, turn = np.linalg.svd(weights, full_matrices=False)
        turned = weights @ turn.T
        scale = np.maximum(np.abs(turned).max(axis=0), 1e-9)
        shapes = np.einsum("jk,kn->jn", turn * scale[: len(turn), None], np.array(self._shapes))
        return shapes.reshape(len(turn), *self.rest.shape), turned / scale

    @property
    def residual(self) -> tuple[float, float]:
        """Root mean square and worst distance in mm between the frames and what the shapes make of them."""
        errors = np.array(self._errors)
        return float(np.sqrt(errors[:, 0].mean())), float(errors[:, 1].max())

    def _split(self, rest: Array) -> tuple[Array, Array]:
        """Return the weights of the shapes so far, and what they leave over."""
        weights = np.zeros(len(self._shapes))
        for k, shape in enumerate(self._shapes):
            weights[k] = float(shape @ rest)
            rest = rest - weights[k] * shape
        return weights, rest

    @staticmethod
    def _worst(rest: Array) -> float:
        return float(np.linalg.norm(rest.reshape(-1, 3), axis=1).max())
