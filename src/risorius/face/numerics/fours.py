"""Four numbers side by side, for use within kernels: instants of a muscle, or x, y, z and an unused 0.

The compiler turns what is done with all four alike into one vector instruction, if all are read before any is
written, and from and to neighbouring places. The order of sums is kept, or it would make other vectors.
"""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import Array, UIntArray
from ...machine.kernels.jit import device, index

LANES = 4
Four = tuple[float, float, float, float]

# Subtracting a third of the bits of x from this gives 1/∛x within 4 %: the fast inverse root, for cubes.
_MAGIC = np.int64(0x553EF0FF289DD796)
_THIRD = np.int64(0x55555556)  # of 2³²
_HALF = np.int64(32)  # bits


@device("fast")
def four(number: float) -> Four:
    """Return four times the same number."""
    return number, number, number, number


@device("fast")
def row(array: Array, i: int) -> Four:
    """Return row i of an array (n, 4)."""
    k = index(i)
    return array[k, 0], array[k, 1], array[k, 2], array[k, 3]


@device("fast")
def set_row(array: Array, i: int, value: Four) -> None:
    """Write `value` to row i of an array (n, 4)."""
    k = index(i)
    array[k, 0], array[k, 1], array[k, 2], array[k, 3] = value


@device("fast")
def product(a: Four, b: Four) -> Four:
    """Return a · b in each lane."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]


@device("fast")
def added(total: Four, a: Four, b: Four) -> Four:
    """Return total + a · b in each lane."""
    return total[0] + a[0] * b[0], total[1] + a[1] * b[1], total[2] + a[2] * b[2], total[3] + a[3] * b[3]


@device("fast")
def added_times(total: Four, a: Four, factor: float) -> Four:
    """Return total + a · factor in each lane."""
    return (
        total[0] + a[0] * factor,
        total[1] + a[1] * factor,
        total[2] + a[2] * factor,
        total[3] + a[3] * factor,
    )


@device("fast")
def squares(x: Four, y: Four, z: Four) -> Four:
    """Return x² + y² + z² in each lane."""
    return added(added(product(x, x), y, y), z, z)


@device("fast")
def put(array: Array, i: int, c: int, value: Four) -> None:
    """Write `value` to `array[i, c]`."""
    array[i, c, 0], array[i, c, 1], array[i, c, 2], array[i, c, 3] = value


@device("fast")
def put_vector(array: Array, i: int, x: Four, y: Four, z: Four) -> Four:
    """Write x, y and z to `array[i]`; return the squares of the lengths."""
    put(array, i, 0, x)
    put(array, i, 1, y)
    put(array, i, 2, z)
    return squares(x, y, z)


@device("fast")
def roots(a: Four) -> Four:
    """Return the square roots."""
    return math.sqrt(a[0]), math.sqrt(a[1]), math.sqrt(a[2]), math.sqrt(a[3])


@device("fast")
def inverse_cube_root(x: float) -> float:
    """Return 1/∛x of a positive number to 13 digits.

    A guess from the bits of `x`, then a step of third and two of second order (Householder).
    """
    upper = np.float64(x).view(np.int64) >> _HALF
    third = (upper * _THIRD) >> _HALF
    guess = np.int64(_MAGIC - (third << _HALF)).view(np.float64)
    error = 1.0 - x * guess * guess * guess
    guess *= 1.0 + error * (1.0 / 3.0 + error * (2.0 / 9.0))
    error = 1.0 - x * guess * guess * guess
    guess *= 1.0 + error * (1.0 / 3.0)
    error = 1.0 - x * guess * guess * guess
    return float(guess * (1.0 + error * (1.0 / 3.0)))


@device("fast", inlined=True)
def spread(points: Array, source: int, row: UIntArray, weight: Array, first: int, last: int) -> None:
    """Subtract `weight[e]` times row `source` of `points` (n, 4) from its row `row[e]`, first ≤ e < last.

    The rows `row[e]` (without sign) must not be `source`.
    """
    s = index(source)
    x, y, z, w = points[s, 0], points[s, 1], points[s, 2], points[s, 3]
    for e in range(first, last):
        i, by = row[e], weight[e]
        p, q, r, t = points[i, 0], points[i, 1], points[i, 2], points[i, 3]
        points[i, 0], points[i, 1], points[i, 2], points[i, 3] = (
            p - by * x,
            q - by * y,
            r - by * z,
            t - by * w,
        )


@device("fast", inlined=True)
def gathered(points: Array, row: UIntArray, weight: Array, first: int, last: int) -> Four:
    """Return Σ weight[e] · points[row[e]] over first ≤ e < last; `points` is (n, 4)."""
    x, y, z, w = 0.0, 0.0, 0.0, 0.0
    p, q, r, t = 0.0, 0.0, 0.0, 0.0
    # Two sums, because each waits for its last addition.
    whole = first + ((last - first) & ~1)
    for e in range(first, whole, 2):
        i, by = row[e], weight[e]
        j, as_well = row[e + 1], weight[e + 1]
        x, y, z, w = (
            x + by * points[i, 0],
            y + by * points[i, 1],
            z + by * points[i, 2],
            w + by * points[i, 3],
        )
        p, q = p + as_well * points[j, 0], q + as_well * points[j, 1]
        r, t = r + as_well * points[j, 2], t + as_well * points[j, 3]
    if whole < last:
        i, by = row[whole], weight[whole]
        x, y, z, w = (
            x + by * points[i, 0],
            y + by * points[i, 1],
            z + by * points[i, 2],
            w + by * points[i, 3],
        )
    return x + p, y + q, z + r, w + t
