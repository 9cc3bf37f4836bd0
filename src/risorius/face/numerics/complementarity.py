"""Pushes that bring gaps into their bounds: projected Gauss-Seidel on the compliance of the skin."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...core.arrays import Array, FloatArray, IntArray
from ...machine.kernels.jit import kernel

# A little softness in the diagonal keeps redundant gaps (neighbours on a stiff lip) from opposing each other.
SOFTNESS = 1.001
CONVERGED = 5e-4  # mm: a sweep that changes every gap by less is the last


class Gaps(NamedTuple):
    """k gaps: each is `gap` + Σ weight · the displacement of its points.

    `points` and `weight` (k, 4); `gap` (k,) mm, and its bounds `low` and `high` (k,).
    """

    points: IntArray
    weight: Array
    gap: Array
    low: Array
    high: Array


class Workspace(NamedTuple):
    """Scratch arrays for up to k gaps over n points: `moved` (n,), `matrix` (k, k), the others (k,)."""

    moved: Array
    matrix: Array
    push: Array
    here: Array

    @classmethod
    def allocate(cls, gaps: int, points: int) -> Workspace:
        """Allocate."""
        return cls(np.zeros(points), np.zeros((gaps, gaps)), np.zeros(gaps), np.zeros(gaps))


def solve_gaps(gaps: Gaps, compliance: FloatArray, sweeps: int, work: Workspace, force: Array) -> None:
    """Add to `force` (n,) the pushes along one axis that bring every gap between `low` and `high`.

    `compliance` (n, n) is the displacement of each point per unit push at each point. A gap that lies within
    its bounds without a push gets none (complementarity).
    """
    _couple(gaps.points, gaps.weight, compliance, work.moved, work.matrix)
    _balance(gaps.gap, gaps.low, gaps.high, sweeps, work.matrix, work.push, work.here)
    _apply(gaps.points, gaps.weight, work.push, force)


@kernel(
    "u4[:, :], f8[:, :], f4[:, :], f8[:], f8[:, :]",
    "u4[:, :], f8[:, :], f8[:, :], f8[:], f8[:, :]",
    arithmetic="sums",
)
def _couple(points: IntArray, weight: Array, compliance: FloatArray, moved: Array, matrix: Array) -> None:
    """Write the opening of each gap per unit push at each other one to `matrix`, which is symmetric."""
    for i in range(len(points)):
        p, q, r, s = points[i, 0], points[i, 1], points[i, 2], points[i, 3]
        a, b, c, d = weight[i, 0], weight[i, 1], weight[i, 2], weight[i, 3]
        for j in range(compliance.shape[0]):
            moved[j] = (
                a * compliance[p, j] + b * compliance[q, j] + c * compliance[r, j] + d * compliance[s, j]
            )
        for j in range(i + 1):
            total = 0.0
            for k in range(4):
                total += weight[j, k] * moved[points[j, k]]
            matrix[i, j] = total
            matrix[j, i] = total


@kernel("f8[:], f8[:], f8[:], i8, f8[:, :], f8[:], f8[:]", arithmetic="sums")
def _balance(
    gap: Array, low: Array, high: Array, sweeps: int, matrix: Array, push: Array, here: Array
) -> None:
    count = len(gap)
    # A loop, because slices of which numba checks the lengths would make this ten times as long.
    for i in range(count):
        push[i], here[i] = 0.0, gap[i]
    for _ in range(sweeps):
        change = 0.0
        for i in range(count):
            stiff = matrix[i, i] * SOFTNESS
            apart, together = push[i] + (low[i] - here[i]) / stiff, push[i] + (high[i] - here[i]) / stiff
            more = max(apart, 0.0) + min(together, 0.0) - push[i]
            if more != 0.0:
                change = max(change, abs(more) * stiff)
                push[i] += more
                for j in range(count):
                    here[j] += matrix[i, j] * more
        if change < CONVERGED:
            break


@kernel("u4[:, :], f8[:, :], f8[:], f8[:]")
def _apply(points: IntArray, weight: Array, push: Array, force: Array) -> None:
    for i in range(len(points)):
        for a in range(4):
            force[points[i, a]] += weight[i, a] * push[i]
