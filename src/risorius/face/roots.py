"""Roots that kernels compute often."""

from __future__ import annotations

from ..core.kernels.four import Four, with_third_of_bits
from ..core.kernels.jit import lean_device

# Subtracting a third of the bits of x from this gives 1/∛x within 4 %: the fast inverse root, for cubes.
_MAGIC = 0x553EF0FF289DD796


@lean_device
def inverse_cube_roots(x: Four) -> Four:
    """Return 1/∛x of positive numbers to 13 digits.

    A guess from the bits of `x`, then a step of third and two of second order (Householder).
    """
    guess = with_third_of_bits(x, _MAGIC)
    error = 1.0 - x * guess * guess * guess
    guess *= 1.0 + error * (1.0 / 3.0 + error * (2.0 / 9.0))
    for _ in range(2):
        error = 1.0 - x * guess * guess * guess
        guess *= 1.0 + error * (1.0 / 3.0)
    return guess
