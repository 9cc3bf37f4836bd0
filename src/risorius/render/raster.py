"""The rule that decides which samples of the picture a triangle covers, in whole numbers.

Positions are snapped to 1/256 sample and edges are tested in integers, so coverage is exact: a sample on an
edge that two triangles share belongs to exactly one of them (the top-left rule).
"""

from __future__ import annotations

from ..core.arrays import ByteArray, Int32Array
from ..machine.kernels.jit import device, i8, index, kernel

SUBPIXEL = 256
HALF = SUBPIXEL // 2
CHUNK = 64  # triangles whose joint extent is tested at once


@device()
def area_of(xy: Int32Array, a: int, b: int, c: int) -> int:
    """Twice the signed area: positive where the corners run clockwise in the picture (y down)."""
    abx = i8(xy[b, 0]) - i8(xy[a, 0])
    aby = i8(xy[b, 1]) - i8(xy[a, 1])
    acx = i8(xy[c, 0]) - i8(xy[a, 0])
    acy = i8(xy[c, 1]) - i8(xy[a, 1])
    return abx * acy - aby * acx


@device()
def extent(p: int, q: int, r: int, limit: int) -> tuple[int, int]:
    """Return the first and last sample whose centre lies between the least and the greatest coordinate."""
    first = (min(p, q, r) - HALF + SUBPIXEL - 1) // SUBPIXEL
    last = (max(p, q, r) - HALF) // SUBPIXEL
    return max(first, 0), min(last, limit - 1)


@device()
def is_ribbon(triangles: Int32Array, t: int, after: int) -> bool:
    """Return whether triangle t and the one drawn `after` it are a segment of a hair.

    That is a quad p, p + 1, p + 3, p + 2, which they share by its diagonal (`looks.strands`).
    """
    p = triangles[t, 0]
    return bool(
        after == t + 1
        and triangles[t, 1] == p + 1
        and triangles[t, 2] == p + 2
        and triangles[after, 0] == p + 1
        and triangles[after, 1] == p + 3
        and triangles[after, 2] == p + 2
    )


@kernel("i4[:, :], i4[:, :], i4[:], u1[:], i8, i8, i4[:, :], i4[:, :]")
def find_rows(
    xy: Int32Array,
    triangles: Int32Array,
    order: Int32Array,
    two_sided: ByteArray,
    height: int,
    width: int,
    rows: Int32Array,
    chunks: Int32Array,
) -> None:
    """Write the first and last row of triangles in `order` (first > last: not drawn) and of chunks.

    The two triangles of a ribbon's segment have their rows together.
    """
    for chunk in range(len(chunks)):
        low, high = height, -1
        for place in range(chunk * CHUNK, min((chunk + 1) * CHUNK, len(order))):
            t = index(order[place])
            a, b, c = index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])
            area = area_of(xy, a, b, c)
            first, last = extent(xy[a, 1], xy[b, 1], xy[c, 1], height)
            left, right = extent(xy[a, 0], xy[b, 0], xy[c, 0], width)
            if area == 0 or (area > 0 and two_sided[t] == 0) or left > right or first > last:
                first, last = height, -1
            before = index(order[max(place - 1, chunk * CHUNK)])
            if is_ribbon(triangles, before, t):
                first, last = min(first, rows[before, 0]), max(last, rows[before, 1])
                rows[before, 0], rows[before, 1] = first, last
            rows[t, 0], rows[t, 1] = first, last
            low, high = min(low, first), max(high, last)
        chunks[chunk, 0], chunks[chunk, 1] = low, high
