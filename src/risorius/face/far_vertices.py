"""Least squares with a penalty for vertices that are far off: the whole surface fits a little worse, so that
no single place is visibly wrong.

The penalty, added to half the weighted sum of squares, is `STRENGTH` · Σ max(d − `FAR`, 0)^`POWER` over the
vertices' distances d in mm. It nearly minimizes the worst distance, but is a strictly convex function of the
weights: there is one minimum, and it moves without jumps as the surface does. Newton's method finds it: each
step is the non-negative least squares of the second-order model, halved while it goes too far (Nocedal and
Wright, Numerical Optimization, 2006, chapters 3 and 18).

A place that no shape can reach would raise shapes that have little to do with it, and others against their
effects elsewhere. So the weights move only by a limited amount from the least squares, straight towards the
minimum; every step in that direction improves the fit.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg.blas import dsyrk

from ..core.arrays import Array

Least = Callable[[Array, Array], Array]
"""(normal, right) -> the weights w within their limits that minimize ½ w·normal·w − right·w."""

FAR, POWER, STRENGTH = 1.5, 8, 1e4  # mm, none, mm⁻⁶
STEPS, STILL = 40, 1e-4  # the most steps; a step that moves every weight by less is the last
LEEWAY = 0.4  # the most that a weight may differ from the least squares
SHORTEST = 1e-3  # the least share of a step that is tried


class FarVertices:
    """The problem for one surface: `moves` (n, 3, s) are the shapes, `wanted` (n, 3) the displacements in mm.

    `normal` (s, s) and `right` (s,) are the normal equations of the least squares.
    """

    def __init__(self, moves: Array, wanted: Array, normal: Array, right: Array) -> None:
        self._moves, self._wanted = moves, wanted
        self._normal, self._right = normal, right

    def minimum(self, weights: Array, least: Least) -> Array:
        """Return the weights (s,) of the least cost, searched from `weights` on."""
        cost, distance = self.cost(weights)
        for _ in range(STEPS):
            if distance.max() <= FAR:
                break
            step = least(*self._model(weights, distance)) - weights
            share = 1.0
            while True:
                here = weights + share * step
                new_cost, distance = self.cost(here)
                if new_cost <= cost or share < SHORTEST:
                    break
                share *= 0.5
            weights, cost = here, new_cost
            if np.abs(share * step).max() < STILL:
                break
        return weights

    def cost(self, weights: Array) -> tuple[float, Array]:
        """Return the cost, up to a constant, and the distances (n,) in mm."""
        distance = lengths(self._wanted - self._moves @ weights)
        squares = weights @ (0.5 * self._normal @ weights - self._right)
        return float(squares + STRENGTH * (np.maximum(distance - FAR, 0.0) ** POWER).sum()), distance

    def _model(self, weights: Array, distance: Array) -> tuple[Array, Array]:
        """Return the normal equations of the second-order model about `weights`."""
        far = np.flatnonzero(distance > FAR)
        moves, away = self._moves[far], distance[far]
        towards = (self._wanted[far] - moves @ weights) / away[:, None]
        first = STRENGTH * POWER * (away - FAR) ** (POWER - 1)
        second = first * (POWER - 1) / (away - FAR)
        along = (towards[:, None] @ moves)[:, 0]
        # A sum of squares: only one half of the matrix is worked out.
        rows = moves.reshape(-1, moves.shape[2]) * np.sqrt(np.repeat(first / away, 3))[:, None]
        half = dsyrk(1.0, rows.T)
        curved = half + np.triu(half, 1).T
        curved += along.T @ (along * (second - first / away)[:, None])
        return self._normal + curved, self._right + curved @ weights + first @ along


def lengths(vectors: Array) -> Array:
    """Return the lengths of vectors (…, 3) -> (…,)."""
    return np.asarray(np.sqrt(np.einsum("...k,...k->...", vectors, vectors)))


def within_leeway(way: Array) -> Array:
    """Return a way from the least squares (s,) that is no longer than `LEEWAY` for any weight."""
    farthest = float(np.abs(way).max())
    return way * (LEEWAY / farthest) if farthest > LEEWAY else way
