"""Least squares that also hold back the vertices that are far off: a little is lost over the whole surface
for what would be seen at one place.

To half the weighted sum of squares comes `STRENGTH` · Σ max(d − `FAR`, 0)^`POWER` over the vertices'
distances d in mm: nearly the least worst vertex, and yet a strictly convex function of the weights, so that
its minimum is one and moves without jumps as the surface does. Found by Newton's method: each step is the
non-negative least squares of the second-order model, halved while it goes too far (Nocedal and Wright,
Numerical Optimization, 2006, chapters 3 and 18).

What no shapes can reach would pull in others that have little to do with the place, and others yet against
what these do elsewhere. So the weights go only so far from the least squares, on the straight way to the
minimum, on which every step is to the better.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..core.arrays import Array

Least = Callable[[Array, Array], Array]
"""Returns the weights that are the least of ½ w·normal·w − right·w, within their limits."""

FAR, POWER, STRENGTH = 1.5, 8, 1e4  # mm, none, mm⁻⁶
STEPS, STILL = 40, 1e-4  # at most so many; a step that moves no weight by more is the last
LEEWAY = 0.4  # by how much a weight may leave the least squares
SHORTEST = 1e-3  # share of a step that is still tried


class FarVertices:
    """The problem for one surface: `basis` (s, 3 n) are the shapes, `wanted` (3 n,) the displacements in mm.

    `normal` (s, s) and `right` (s,) are the normal equations of the least squares.
    """

    def __init__(self, basis: Array, wanted: Array, normal: Array, right: Array) -> None:
        self._basis, self._wanted = basis, wanted
        self._normal, self._right = normal, right

    def settle(self, weights: Array, least: Least) -> Array:
        """Return the weights (s,), from those of the least squares; `least` keeps weights within limits."""
        way = self.minimum(weights, least) - weights
        farthest = float(np.abs(way).max())
        return weights + way * (LEEWAY / farthest) if farthest > LEEWAY else weights + way

    def minimum(self, weights: Array, least: Least) -> Array:
        """Return the weights (s,) that cost least, on the way from those given."""
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
        """Return what is made least, up to a constant, and the distances (n,) in mm."""
        distance = np.linalg.norm((self._wanted - weights @ self._basis).reshape(-1, 3), axis=1)
        squares = weights @ (0.5 * self._normal @ weights - self._right)
        return float(squares + STRENGTH * (np.maximum(distance - FAR, 0.0) ** POWER).sum()), distance

    def _model(self, weights: Array, distance: Array) -> tuple[Array, Array]:
        """Return the normal equations of the second-order model about `weights`."""
        far = np.flatnonzero(distance > FAR)
        columns = (3 * far[:, None] + np.arange(3)).ravel()
        basis, away = self._basis[:, columns], distance[far]
        towards = (self._wanted[columns] - weights @ basis).reshape(-1, 3) / away[:, None]
        first = STRENGTH * POWER * (away - FAR) ** (POWER - 1)
        second = first * (POWER - 1) / (away - FAR)
        along = np.einsum("snk,nk->sn", basis.reshape(len(basis), -1, 3), towards)
        curved = (basis * np.repeat(first / away, 3)) @ basis.T + (along * (second - first / away)) @ along.T
        return self._normal + curved, self._right + curved @ weights + along @ first
