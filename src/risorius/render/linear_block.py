"""Read the colours of the four samples of a pixel at once, which the compiler does in vector registers."""

from __future__ import annotations

from ..core.arrays import Float32Array
from ..machine.kernels.jit import device, f4, index

GROUP = 8
"""Columns that are read at once."""
COLUMNS = 4 * GROUP
"""Columns of a row of `linear.LinearTriangles.planes`."""
SAMPLES = 4
CONSTANT = 4
"""Constant values that are read of a row, the first of its last group."""
MEANS = GROUP + CONSTANT
_RIGHT, _DOWN, _SAME = GROUP, 2 * GROUP, 3 * GROUP

_Rows = tuple[int, int, int, int]


@device("sums", inlined=True)
def mean_at(planes: Float32Array, rows: _Rows, x: float, y: float, means: Float32Array) -> None:
    """Write the means over the 2 × 2 samples from (x, y) on, (float32) the middle of the first, to `means`.

    `planes` (n, COLUMNS) float32 holds GROUP values at the origin, what they gain from sample to sample to
    the right, what they gain downwards, and GROUP values that do not change; `rows` are the rows of the
    samples' triangles. The first GROUP of the `means` (MEANS,) are those of linear values, the others of
    constant ones.
    """
    a, b, c, d = index(rows[0]), index(rows[1]), index(rows[2]), index(rows[3])
    right, below, share = x + f4(1), y + f4(1), f4(1.0 / SAMPLES)
    for k in range(GROUP):
        total = planes[a, k] + planes[b, k] + planes[c, k] + planes[d, k]
        total += x * (planes[a, _RIGHT + k] + planes[c, _RIGHT + k])
        total += right * (planes[b, _RIGHT + k] + planes[d, _RIGHT + k])
        total += y * (planes[a, _DOWN + k] + planes[b, _DOWN + k])
        total += below * (planes[c, _DOWN + k] + planes[d, _DOWN + k])
        means[k] = share * total
    for k in range(CONSTANT):
        s = _SAME + k
        means[GROUP + k] = share * (planes[a, s] + planes[b, s] + planes[c, s] + planes[d, s])
