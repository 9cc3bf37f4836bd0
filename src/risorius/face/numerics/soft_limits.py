"""Non-negative least squares of a few unknowns under limits that yield a little, as stiff springs do.

The cost is ½ w·normal·w − right·w + ½ Σ stiff · max(rows·w − limit, 0)², over w ≥ 0. It is strictly convex
and its slope is continuous: there is one minimum, and it moves without jumps as the limits do, so nothing
switches when one begins to bind. Limits that contradict each other are all missed by a little. The minimum is
found by Newton's method: each step is the non-negative least squares with the limits that are passed,
shortened while it does not lower the cost.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, BoolArray, IndexArray
from ...machine.kernels.jit import device, kernel
from .nonnegative import find_positive

STEPS, STILL = 60, 1e-9  # the most steps; one that moves every unknown by less is the last
SHORTEST = 1e-3  # the least share of a step that is tried


def within_limits(
    normal: Array, right: Array, rows: Array, limit: Array, stiff: Array, begin: Array
) -> Array:
    """Return the minima (n, s) of n problems with one `normal` (s, s), sought from `begin` (n, s).

    `right` (n, s), `rows` (n, k, s), `limit` and `stiff` (n, k) are those of each problem.
    """
    count, size = begin.shape
    weights = np.ascontiguousarray(np.maximum(begin, 0.0))
    right, rows, limit, stiff = map(np.ascontiguousarray, (right, rows, limit, stiff))
    scratch, chosen, state = (
        np.empty((size + 1, size)),
        np.empty(size, np.int64),
        np.zeros((2, size), np.bool_),
    )
    model, vectors = np.empty((size, size)), np.empty((4, size))
    for k in range(count):
        _minimize(
            normal,
            right[k],
            rows[k],
            limit[k],
            stiff[k],
            model,
            vectors,
            scratch,
            chosen,
            state[0],
            state[1],
            weights[k],
        )
    return weights


@kernel(
    "f8[:, :], f8[:], f8[:, :], f8[:], f8[:], f8[:, :], f8[:, :], f8[:, :], i8[:], b1[:], b1[:], f8[:]",
    arithmetic="sums",
)
def _minimize(
    normal: Array,
    right: Array,
    rows: Array,
    limit: Array,
    stiff: Array,
    model: Array,
    vectors: Array,
    scratch: Array,
    chosen: IndexArray,
    positive: BoolArray,
    wrong: BoolArray,
    weights: Array,
) -> None:
    """Move `weights` (s,) to the minimum; what is between `stiff` and them is scratch."""
    side, end, here, slope = vectors[0], vectors[1], vectors[2], vectors[3]
    for _ in range(STEPS):
        for i in range(len(weights)):
            positive[i] = weights[i] > 0.0
            here[i] = weights[i]
        cost = _gather(normal, right, rows, limit, stiff, weights, model, side, slope)
        find_positive(model, side, scratch, chosen, positive, wrong, end)
        farthest = 0.0
        for i in range(len(weights)):
            farthest = max(farthest, abs(end[i] - here[i]))
        share = 1.0
        while True:
            for i in range(len(weights)):
                weights[i] = here[i] + share * (end[i] - here[i])
            if _cost(normal, right, rows, limit, stiff, weights) <= cost or share < SHORTEST:
                break
            share *= 0.5
        if share * farthest < STILL:
            break


@device("sums")
def _gather(
    normal: Array,
    right: Array,
    rows: Array,
    limit: Array,
    stiff: Array,
    weights: Array,
    model: Array,
    side: Array,
    slope: Array,
) -> float:
    """Write the normal equations with the limits that `weights` pass; return the cost."""
    size, cost = len(weights), 0.0
    for i in range(size):
        side[i], slope[i] = right[i], 0.0
        for j in range(size):
            model[i, j] = normal[i, j]
            slope[i] += normal[i, j] * weights[j]
        cost += weights[i] * (0.5 * slope[i] - right[i])
    for k in range(len(rows)):
        over = -limit[k]
        for i in range(size):
            over += rows[k, i] * weights[i]
        if over <= 0.0:
            continue
        cost += 0.5 * stiff[k] * over * over
        for i in range(size):
            pull = stiff[k] * rows[k, i]
            side[i] += pull * limit[k]
            for j in range(i + 1):
                model[i, j] += pull * rows[k, j]
    for i in range(size):
        for j in range(i):
            model[j, i] = model[i, j]
    return cost


@device("sums")
def _cost(normal: Array, right: Array, rows: Array, limit: Array, stiff: Array, weights: Array) -> float:
    """Return the cost of some weights."""
    cost = 0.0
    for i in range(len(weights)):
        total = 0.0
        for j in range(len(weights)):
            total += normal[i, j] * weights[j]
        cost += weights[i] * (0.5 * total - right[i])
    for k in range(len(rows)):
        over = -limit[k]
        for i in range(len(weights)):
            over += rows[k, i] * weights[i]
        cost += 0.5 * stiff[k] * max(over, 0.0) ** 2
    return cost
