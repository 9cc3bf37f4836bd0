"""Four numbers in one register do what each of them would do alone."""

from __future__ import annotations

import numpy as np

from risorius.core.kernels.four import any_above, four, larger, root, row, set_row, where_above
from risorius.core.kernels.jit import lean_kernel

A = np.array([[1.0, -2.0, 3.5, 0.25]])
B = np.array([[4.0, 0.5, -1.0, 0.25]])


@lean_kernel
def all_operations(a, b, out):
    x, y = row(a, 0), row(b, 0)
    set_row(out, 0, x + y)
    set_row(out, 1, x - 2.0 * y)
    set_row(out, 2, (x * 3.0) / y)
    set_row(out, 3, root(larger(x, four(0.0))))
    set_row(out, 4, where_above(x, 0.5, y, four(7.0)))
    total = four(1.0)
    for _ in range(3):
        total += x
        total *= y
    set_row(out, 5, total)
    return any_above(x, 3.4), any_above(x, 3.5)


def test_each_lane_is_what_one_number_gives():
    out = np.full((6, 2, 2), np.nan)  # rows of four, whatever the axes
    assert all_operations(A, B, out) == (True, False)
    total = np.ones_like(A)
    for _ in range(3):
        total = (total + A) * B
    wanted = [A + B, A - 2 * B, 3 * A / B, np.sqrt(np.maximum(A, 0)), np.where(A > 0.5, B, 7.0), total]
    np.testing.assert_allclose(out.reshape(6, 4), np.vstack(wanted), rtol=1e-15)
