"""Pushes that bring gaps into their bounds: projected Gauss-Seidel on the compliance of the skin."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .jit import compiled, compiled_fast

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]

# A little softness in the diagonal keeps redundant gaps (neighbours on a stiff lip) from fighting.
SOFTNESS = 1.001
SETTLED = 5e-4  # mm of change in a sweep below which the pushes are settled


class Gaps(NamedTuple):
    """The k gaps to settle: each is `gap` + Σ weight · the displacement of its points.

    `points` and `weight` (k, 4); `gap` (k,) mm as it is, `low` and `high` (k,) as it may be.
    """

    points: IntArray
    weight: Array
    gap: Array
    low: Array
    high: Array


class Workspace(NamedTuple):
    """Scratch arrays for up to k gaps over n points: `moved` (k, n), `matrix` (k, k), `push` (k,)."""

    moved: Array
    matrix: Array
    push: Array

    @classmethod
    def room_for(cls, gaps: int, points: int) -> Workspace:
        """Allocate."""
        return cls(np.zeros((gaps, points)), np.zeros((gaps, gaps)), np.zeros(gaps))


def settle(gaps: Gaps, compliance: Array, sweeps: int, work: Workspace, force: Array) -> None:
    """Add to `force` (n,) the pushes along one axis that bring every gap between `low` and `high`.

    `compliance` (n, n) is the displacement of each point per unit push at each point. A gap that lies within
    its bounds without a push gets none (complementarity).
    """
    _couple(gaps.points, gaps.weight, compliance, work.moved, work.matrix)
    _balance(gaps.gap, gaps.low, gaps.high, sweeps, work.matrix, work.push)
    _apply(gaps.points, gaps.weight, work.push, force)


@compiled_fast
def _couple(points: IntArray, weight: Array, compliance: Array, moved: Array, matrix: Array) -> None:
    """Write how much each gap opens per unit push at each other to `matrix`."""
    for i in range(len(points)):
        moved[i] = 0.0
        for a in range(4):
            w, row = weight[i, a], points[i, a]
            for j in range(compliance.shape[0]):
                moved[i, j] += w * compliance[row, j]
        for j in range(len(points)):
            total = 0.0
            for a in range(4):
                total += weight[j, a] * moved[i, points[j, a]]
            matrix[i, j] = total


@compiled_fast
def _balance(gap: Array, low: Array, high: Array, sweeps: int, matrix: Array, push: Array) -> None:
    count = len(gap)
    push[:count] = 0.0
    for _ in range(sweeps):
        change = 0.0
        for i in range(count):
            here = gap[i]
            for j in range(count):
                here += matrix[i, j] * push[j]
            stiff = matrix[i, i] * SOFTNESS
            apart, together = push[i] + (low[i] - here) / stiff, push[i] + (high[i] - here) / stiff
            wanted = max(apart, 0.0) + min(together, 0.0)
            change = max(change, abs(wanted - push[i]) * stiff)
            push[i] = wanted
        if change < SETTLED:
            break


@compiled
def _apply(points: IntArray, weight: Array, push: Array, force: Array) -> None:
    for i in range(len(points)):
        for a in range(4):
            force[points[i, a]] += weight[i, a] * push[i]
