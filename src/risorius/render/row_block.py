"""Test and write sixteen samples of a row at once, which the compiler does in vector registers."""

from __future__ import annotations

from ..core.arrays import Float32Array, Int32Array
from ..machine.kernels.jit import device, f4, i4, index

LANES = 16

Three = tuple[int, int, int]
Five = tuple[int, int, int, int, int]


@device("sums", inlined=True)
def cover(
    depth: Float32Array,
    ids: Int32Array,
    y: int,
    x: int,
    edges: Three,
    steps: Three,
    key: float,
    step: float,
    number: int,
) -> None:
    """Give those of LANES samples from row y and column x on to triangle `number` that it is the nearest in.

    `edges` are the triangle's three edge functions at the first sample, `steps` their increments (int32): a
    sample is covered if none of the three is negative. `key` (float32) is the nearness at the first sample,
    `step` its increment.
    """
    for lane in range(LANES):
        k, column = i4(lane), index(x) + index(lane)
        below = (edges[0] + steps[0] * k) | (edges[1] + steps[1] * k) | (edges[2] + steps[2] * k)
        near, old, shown = key + step * f4(lane), depth[index(y), column], ids[index(y), column]
        wins = (i4(below) >= i4(0)) & (near > old)
        depth[index(y), column] = near if wins else old
        ids[index(y), column] = number if wins else shown


@device("sums", inlined=True)
def cover_ribbon(
    depth: Float32Array,
    ids: Int32Array,
    y: int,
    x: int,
    edges: Five,
    steps: Five,
    key: float,
    step: float,
    number: int,
) -> None:
    """Do what `cover` does for a quad of two triangles, `number` and the next.

    Of the five edge functions the last is the diagonal's: it is negative in the second triangle.
    """
    for lane in range(LANES):
        k, column = i4(lane), index(x) + index(lane)
        below = (edges[0] + steps[0] * k) | (edges[1] + steps[1] * k)
        below |= (edges[2] + steps[2] * k) | (edges[3] + steps[3] * k)
        near, old, shown = key + step * f4(lane), depth[index(y), column], ids[index(y), column]
        wins = (i4(below) >= i4(0)) & (near > old)
        depth[index(y), column] = near if wins else old
        beyond = i4(edges[4] + steps[4] * k) >> i4(31)
        ids[index(y), column] = i4(number - beyond) if wins else shown


@device("sums", inlined=True)
def cover_depth(
    depth: Float32Array, y: int, x: int, edges: Three, steps: Three, key: float, step: float
) -> None:
    """Do what `cover` does without recording which triangle a sample shows."""
    for lane in range(LANES):
        k, column = i4(lane), index(x) + index(lane)
        below = (edges[0] + steps[0] * k) | (edges[1] + steps[1] * k) | (edges[2] + steps[2] * k)
        near, old = key + step * f4(lane), depth[index(y), column]
        wins = (i4(below) >= i4(0)) & (near > old)
        depth[index(y), column] = near if wins else old
