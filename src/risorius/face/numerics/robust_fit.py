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

from typing import NamedTuple

import numpy as np

from ...core.arrays import Array
from ...machine.kernels.jit import kernel
from .nonnegative import least_squares

FAR, POWER, STRENGTH = 1.5, 8, 4e4  # mm, none, mm⁻⁶
STEPS, STILL = 40, 1e-5  # the most steps; a step that moves every weight by less is the last
LEEWAY = 0.4  # the most that a weight may differ from the least squares
SHORTEST = 1e-3  # the least share of a step that is tried


class SurfaceCost(NamedTuple):
    """The cost of some weights, up to a constant; the rest of each way (n, 3), its length (n,), mm."""

    cost: float
    away: Array
    distance: Array


class RobustFit:
    """The problem for one surface: `moves` (n, 3, s) are the shapes, in mm at weight 1.

    `normal` (s, s) and `right` (s,) are the normal equations of the least squares; `start` (s,) is their
    solution, and `left` (n, 3) mm what it leaves of the displacements.
    """

    def __init__(self, moves: Array, left: Array, normal: Array, right: Array, start: Array) -> None:
        self._moves, self._left = moves, left
        self._normal, self._right, self._start = normal, right, start

    def minimum(self, guess: Array) -> Array:
        """Return the weights (s,) ≥ 0 of the least cost, searched from `guess` (s,) or the start on."""
        weights = self._start
        here = self.at(weights)
        if guess is not weights:
            there = self.at(guess)
            if there.cost < here.cost:
                weights, here = guess, there
        for _ in range(STEPS):
            if here.distance.max() <= FAR or not len(weights):
                break
            step = least_squares(*self._model(weights, here), weights) - weights
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
        away, distance = np.empty_like(self._left), np.empty(len(self._left))
        penalty = subtract_moves(self._moves, self._left, weights - self._start, away, distance)
        squares = weights @ (0.5 * self._normal @ weights - self._right)
        return SurfaceCost(float(squares + penalty), away, distance)

    def _model(self, weights: Array, here: SurfaceCost) -> tuple[Array, Array]:
        """Return the normal equations of the second-order model about `weights`."""
        curved, pull = np.zeros_like(self._normal), np.zeros_like(weights)
        _curve(self._moves, here.away, here.distance, np.empty_like(weights), curved, pull)
        return self._normal + curved, self._right + curved @ weights + pull


@kernel("f8[:, :, :], f8[:, :], f8[:], f8[:, :], f8[:] -> f8", arithmetic="sums")
def subtract_moves(moves: Array, left: Array, change: Array, away: Array, distance: Array) -> float:
    """Write the rest of `left` (n, 3) after a `change` (s,) of weights, its lengths; return the penalty."""
    penalty = 0.0
    for v in range(len(left)):
        square = 0.0
        for c in range(3):
            rest = left[v, c]
            for s in range(len(change)):
                rest -= moves[v, c, s] * change[s]
            away[v, c] = rest
            square += rest * rest
        distance[v] = np.sqrt(square)
        penalty += max(distance[v] - FAR, 0.0) ** POWER
    return STRENGTH * penalty


@kernel("f8[:, :, :], f8[:, :], f8[:], f8[:], f8[:, :], f8[:]", arithmetic="sums")
def _curve(moves: Array, away: Array, distance: Array, along: Array, curved: Array, pull: Array) -> None:
    """Add the penalty's second derivatives to `curved` (s, s), and the pull on the weights to `pull` (s,).

    `along` (s,) is scratch.
    """
    count = len(pull)
    for v in range(len(away)):
        over = distance[v] - FAR
        if over <= 0.0:
            continue
        first = STRENGTH * POWER * over ** (POWER - 1)
        second = first * (POWER - 1) / over
        across = first / distance[v]
        x, y, z = away[v, 0] / distance[v], away[v, 1] / distance[v], away[v, 2] / distance[v]
        for s in range(count):
            along[s] = x * moves[v, 0, s] + y * moves[v, 1, s] + z * moves[v, 2, s]
            pull[s] += first * along[s]
        for i in range(count):
            a, b, c = across * moves[v, 0, i], across * moves[v, 1, i], across * moves[v, 2, i]
            d = (second - across) * along[i]
            for j in range(i + 1):
                curved[i, j] += a * moves[v, 0, j] + b * moves[v, 1, j] + c * moves[v, 2, j] + d * along[j]
    for i in range(count):
        for j in range(i):
            curved[j, i] = curved[i, j]


def lengths(vectors: Array) -> Array:
    """Return the lengths of vectors (n, 3) -> (n,)."""
    result = np.empty(len(vectors))
    _measure(np.ascontiguousarray(vectors), result)
    return result


@kernel("f8[:, :], f8[:]")
def _measure(vectors: Array, result: Array) -> None:
    for i in range(len(vectors)):
        x, y, z = vectors[i, 0], vectors[i, 1], vectors[i, 2]
        result[i] = np.sqrt(x * x + y * y + z * z)


def within_leeway(way: Array) -> Array:
    """Return the step (s,) from the least squares, scaled so that no weight moves by more than `LEEWAY`."""
    farthest = float(np.abs(way).max())
    return way * (LEEWAY / farthest) if farthest > LEEWAY else way
