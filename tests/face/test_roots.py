from __future__ import annotations

import numpy as np

from risorius.core.kernels.four import row, set_row
from risorius.core.kernels.jit import lean_kernel
from risorius.face.roots import inverse_cube_roots


@lean_kernel
def roots_of(numbers, out):
    set_row(out, 0, inverse_cube_roots(row(numbers, 0)))


def test_inverse_cube_roots_are_exact_to_13_digits():
    out = np.zeros((1, 4))
    for x in (1.0, 1.0 + 1e-12, 1.9, 2.1, 7.9, 8.1, 1e3, 1e9, 1e30, 1e90, 1e-3, 1e-30):
        numbers = x * np.array([[1.0, 1.01, 3.7, 5.2]])
        roots_of(numbers, out)
        np.testing.assert_allclose(out * np.cbrt(numbers), 1.0, atol=1e-13)
