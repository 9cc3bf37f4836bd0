"""The effect of each muscle on a face, and the muscles for a wanted effect: for faces captured elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import nnls

from ...core.arrays import Array
from ...core.parameters import INDEX, MUSCLES, NEUTRAL, PARAMETERS
from ..frame import FaceFrame
from ..solve import FaceSolver

Measure = Callable[[FaceFrame], Array]

TONGUE = ("tongue_up", "tongue_out", "tongue_back")
FITTED = (*(muscle.name for muscle in MUSCLES), "lip_tuck")
# Keeps muscles with nearly the same effect from cancelling each other at high activations.
_RIDGE = 2e-3


class MuscleFit:
    """Non-negative least squares of measures over the muscles of one head, or over the parameters `fitted`.

    `measure` returns numbers (n,) of a frame, 0 at rest. Each column is the effect of a single muscle at
    activation 1, with its linked muscles. The fit adds the effects up, which is a little too much, because
    the solver limits near-parallel pulls.
    """

    def __init__(self, solver: FaceSolver, measure: Measure, fitted: Sequence[str] = FITTED) -> None:
        rest = measure(solver.solve(NEUTRAL)).copy()
        self._columns = np.stack([measure(solver.solve(_alone(name))) - rest for name in fitted], axis=1)
        self._places = [INDEX[name] for name in fitted]

    def values(self, wanted: Array, rows: Sequence[int]) -> Array:
        """Return the values (frames, 46) whose measures are nearest to `wanted` (frames, n).

        `rows` are the measures that count. Parameters that are not fitted stay at rest.
        """
        columns = self._columns[list(rows)]
        return self._nearest(columns, wanted[:, list(rows)] @ columns)

    def of_shapes(self, weights: Array, shapes: Array) -> Array:
        """Return the same for measures that are sums of `shapes` (s, n) by `weights` (frames, s)."""
        return self._nearest(self._columns, weights @ (shapes @ self._columns))

    def _nearest(self, columns: Array, right: Array) -> Array:
        """Return values (frames, 46) of normal equations with the right sides `right` (frames, muscles)."""
        normal = columns.T @ columns
        scale = float(np.trace(normal)) / len(normal)
        factor = np.linalg.cholesky(normal + _RIDGE * scale * np.eye(len(normal)))
        result = np.tile(NEUTRAL, (len(right), 1))
        for row, target in zip(result, right, strict=True):
            activations = nnls(factor.T, np.linalg.solve(factor, target))[0]
            row[self._places] = np.minimum(activations, 1.0)
        return result


def _alone(name: str) -> Array:
    values = np.array(NEUTRAL)
    values[INDEX[name]] = PARAMETERS[INDEX[name]].high
    return values
