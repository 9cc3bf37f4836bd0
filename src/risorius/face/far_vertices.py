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
from typing import NamedTuple

import numpy as np
from scipy.linalg.blas import dsyrk

from ..core.arrays import Array, BoolArray

Least = Callable[[Array, Array], Array]
"""(normal, right) -> the weights w within their limits that minimize ½ w·normal·w − right·w."""

FAR, POWER, STRENGTH = 1.5, 8, 4e4  # mm, none, mm⁻⁶
STEPS, STILL = 40, 1e-5  # the most steps; a step that moves every weight by less is the last
LEEWAY = 0.4  # the most that a weight may differ from the least squares
SHORTEST = 1e-3  # the least share of a step that is tried


class SurfaceCost(NamedTuple):
    """The cost of some weights, up to a constant; what they leave of each way (n, 3), its length (n,), mm."""

    cost: float
    away: Array
    distance: Array


class FarVertices:
    """The problem for one surface: `moves` (n, 3, s) are the shapes, `wanted` (n, 3) the displacements in mm.

    `normal` (s, s) and `right` (s,) are the normal equations of the least squares; `start` (s,) is their
    solution. Only the shapes that are `free` (s,), and move one of the vertices, can bring it nearer.
    """

    def __init__(
        self, moves: Array, wanted: Array, normal: Array, right: Array, start: Array, free: BoolArray
    ) -> None:
        self._normal, self._right, self._start = normal, right, start
        chosen = free & moves.any(axis=(0, 1))
        self._chosen = np.flatnonzero(chosen)
        self._square = np.ix_(self._chosen, self._chosen)
        columns = moves.reshape(3 * len(moves), -1)
        self._moves = np.ascontiguousarray(columns[:, self._chosen])
        self._wanted = (wanted - moves[:, :, ~chosen] @ start[~chosen]).ravel()

    def minimum(self, least: Least, guess: Array) -> Array:
        """Return the weights (s,) of the least cost, searched from `guess` (s,) or the start on."""
        weights = self._start
        here = self.at(weights)
        if guess is not weights:
            there = self.at(guess)
            if there.cost < here.cost:
                weights, here = guess, there
        for _ in range(STEPS):
            if here.distance.max() <= FAR or not len(self._chosen):
                break
            step = least(*self._model(weights, here)) - weights
            share = 1.0
            while True:
                there = self.at(weights + share * step)
                if there.cost <= here.cost or share < SHORTEST:
                    break
                share *= 0.5
            weights, here = weights + share * step, there
            if np.abs(share * step).max() < STILL:
                break
        return weights

    def at(self, weights: Array) -> SurfaceCost:
        """Return the cost of some weights (s,), and how far they leave the vertices."""
        away = (self._wanted - self._moves @ weights[self._chosen]).reshape(-1, 3)
        distance = lengths(away)
        squares = weights @ (0.5 * self._normal @ weights - self._right)
        cost = float(squares + STRENGTH * (np.maximum(distance - FAR, 0.0) ** POWER).sum())
        return SurfaceCost(cost, away, distance)

    def _model(self, weights: Array, here: SurfaceCost) -> tuple[Array, Array]:
        """Return the normal equations of the second-order model about `weights`."""
        far = np.flatnonzero(here.distance > FAR)
        moves, away = self._moves.reshape(len(here.distance), 3, -1)[far], here.distance[far]
        towards = here.away[far] / away[:, None]
        first = STRENGTH * POWER * (away - FAR) ** (POWER - 1)
        second = first * (POWER - 1) / (away - FAR)
        along = (towards[:, None] @ moves)[:, 0]
        # A sum of squares: only one half of the matrix is worked out.
        rows = moves.reshape(-1, moves.shape[2]) * np.sqrt(np.repeat(first / away, 3))[:, None]
        half = dsyrk(1.0, rows.T)
        curved = half + np.triu(half, 1).T
        curved += along.T @ (along * (second - first / away)[:, None])
        normal, right = self._normal.copy(), self._right.copy()
        normal[self._square] += curved
        right[self._chosen] += curved @ weights[self._chosen] + first @ along
        return normal, right


def lengths(vectors: Array) -> Array:
    """Return the lengths of vectors (…, 3) -> (…,)."""
    return np.asarray(np.sqrt(np.einsum("...k,...k->...", vectors, vectors)))


def within_leeway(way: Array) -> Array:
    """Return a way from the least squares (s,) that is no longer than `LEEWAY` for any weight."""
    farthest = float(np.abs(way).max())
    return way * (LEEWAY / farthest) if farthest > LEEWAY else way
