"""Non-negative least squares of a few unknowns by their normal equations: block principal pivoting.

Each round solves for the unknowns that are taken to be positive, as if they had no limit. Those that come out
negative become 0, and those at 0 that would lower the cost become positive: all at once, or, if that has
not lessened their number for some rounds, only the last of them (Portugal, Júdice, Vicente, A comparison of
block pivoting and interior-point algorithms for linear least squares problems, Mathematics of Computation 63,
1994). The result depends only on which unknowns are positive in the end, not on where the search began; a
beginning near the end makes it short.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, BoolArray, IndexArray
from ...machine.kernels.jit import device, kernel

PATIENCE = 3  # rounds in which the number of wrong unknowns does not fall, until they change one by one
ROUNDING = 1e-12  # of the largest right side: an unknown at 0 that would gain less stays
MOST = 1000  # rounds; a handful is usual


def least_squares(normal: Array, right: Array, begin: Array) -> Array:
    """Return the w ≥ 0 (n,) that minimize ½ w·normal·w − right·w.

    `normal` (n, n) is symmetric and positive definite, `right` (n,). The search begins with those unknowns
    positive that are so in `begin` (n,).
    """
    count = len(right)
    state, weights = np.zeros((2, count), np.bool_), np.zeros(count)
    np.greater(begin, 0.0, out=state[0])
    search(
        normal, right, np.empty((count + 1, count)), np.empty(count, np.int64), state[0], state[1], weights
    )
    return weights


@kernel("f8[:, :], f8[:], f8[:, :], i8[:], b1[:], b1[:], f8[:]", arithmetic="sums")
def search(
    normal: Array,
    right: Array,
    scratch: Array,
    chosen: IndexArray,
    positive: BoolArray,
    wrong: BoolArray,
    weights: Array,
) -> None:
    """Write the solution to `weights`, as `find_positive` does."""
    find_positive(normal, right, scratch, chosen, positive, wrong, weights)


@device("sums")
def find_positive(
    normal: Array,
    right: Array,
    scratch: Array,
    chosen: IndexArray,
    positive: BoolArray,
    wrong: BoolArray,
    weights: Array,
) -> None:
    """Write the solution to `weights`; `scratch` (n + 1, n) and `chosen`, `wrong` (n,) are scratch."""
    fewest, patience = len(right) + 1, PATIENCE
    for _ in range(MOST):
        many = 0
        for i in range(len(positive)):
            if positive[i]:
                chosen[many] = i
                many += 1
        _solve_for(chosen, many, normal, right, scratch, weights)
        count = _mark_wrong(normal, right, weights, positive, wrong)
        if count == 0:
            break
        patience = PATIENCE if count < fewest else patience - 1
        fewest = min(fewest, count)
        _change(positive, wrong, patience >= 0)


@device("sums")
def _solve_for(
    chosen: IndexArray, count: int, normal: Array, right: Array, factor: Array, weights: Array
) -> None:
    """Write the least squares of the first `count` unknowns of `chosen` to `weights` (n,), 0 for all others.

    `factor` (n + 1, n) is scratch: the lower triangle of the chosen rows' Cholesky factor, and their solution
    in the last row.
    """
    last = len(weights)
    for i in range(last):
        weights[i] = 0.0
    for i in range(count):
        for j in range(i + 1):
            total = normal[chosen[i], chosen[j]]
            for k in range(j):
                total -= factor[i, k] * factor[j, k]
            factor[i, j] = np.sqrt(total) if i == j else total / factor[j, j]
        total = right[chosen[i]]
        for k in range(i):
            total -= factor[i, k] * factor[last, k]
        factor[last, i] = total / factor[i, i]
    for i in range(count - 1, -1, -1):
        factor[last, i] /= factor[i, i]
        weights[chosen[i]] = factor[last, i]
        for k in range(i):
            factor[last, k] -= factor[i, k] * factor[last, i]


@device("sums")
def _mark_wrong(normal: Array, right: Array, weights: Array, positive: BoolArray, wrong: BoolArray) -> int:
    """Mark the unknowns that are below their limit, or at it and would gain above it; return how many."""
    largest = 0.0
    for value in right:
        largest = max(largest, abs(value))
    count = 0
    for i in range(len(right)):
        if positive[i]:
            wrong[i] = weights[i] < 0.0
        else:
            gain = right[i]
            for j in range(len(right)):
                gain -= normal[i, j] * weights[j]
            wrong[i] = gain > ROUNDING * largest
        count += wrong[i]
    return count


@device("sums")
def _change(positive: BoolArray, wrong: BoolArray, together: bool) -> None:
    """Take the wrong unknowns out of the positive ones, or into them: all `together`, or the last one."""
    for i in range(len(wrong) - 1, -1, -1):
        if wrong[i]:
            positive[i] = not positive[i]
            if not together:
                break
