"""The head's rotation, applied to the vertices of a frame."""

from __future__ import annotations

from ..core.arrays import Float32Array
from ..machine.kernels.jit import kernel


@kernel("f4[:, :], f4[:], f4[:, :], f4[:], f4[:, :]")
def turn(
    points: Float32Array, weight: Float32Array, rotation: Float32Array, pivot: Float32Array, out: Float32Array
) -> None:
    """Rotate points (n, 3) about `pivot` (3,), each by its share `weight` (n,) of `rotation` (3, 3)."""
    for i in range(len(points)):
        x, y, z = points[i, 0] - pivot[0], points[i, 1] - pivot[1], points[i, 2] - pivot[2]
        for row in range(3):
            moved = rotation[row, 0] * x + rotation[row, 1] * y + rotation[row, 2] * z + pivot[row]
            out[i, row] = points[i, row] + weight[i] * (moved - points[i, row])
