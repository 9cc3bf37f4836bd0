"""Fill a triangle by sixteen samples at once, or row by row if its numbers could overflow 32 bits."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..core.arrays import Float32Array, Int32Array
from ..machine.kernels.jit import device, f4, f8, i4, i8, index
from ..machine.kernels.vec import Vec
from .raster import HALF, SUBPIXEL, area_of, extent
from .row_block import LANES, cover, cover_depth, cover_ribbon

_MOST = 1 << 30
"""Width times height, in 1/SUBPIXEL², of triangles whose edge functions are sure to fit in 32 bits."""
_NEVER = f4(1e9)

CornerPlaces = tuple[float, float, float, float, float, float]
"""x and y of the three corners in 1/SUBPIXEL samples."""
EdgeValues = tuple[int, int, int]
"""One whole number for each edge of a triangle."""


class TriangleScan(NamedTuple):
    """The rows and columns that may hold a triangle's samples, and the numbers that decide which do.

    They are the rows from `first` to `last` and the columns from `left` to `right`. `edges` are the edge
    functions at sample (`left`, `first`); `steps` and `downs` are their increments to the right and
    downwards. `near` is the key at that sample and its two increments.
    """

    first: int
    last: int
    left: int
    right: int
    edges: EdgeValues
    steps: EdgeValues
    downs: EdgeValues
    near: Vec


@device("fast", inlined=True)
def fill(
    xy: Int32Array,
    key: Float32Array,
    triangles: Int32Array,
    t: int,
    first: int,
    last: int,
    depth: Float32Array,
    ids: Int32Array,
    keep: bool,
) -> None:
    """Draw the rows from `first` to `last` of triangle t; `ids` is written only if `keep` is true."""
    a, b, c = index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])
    area = area_of(xy, a, b, c)
    if area < 0:
        b, c, area = c, b, -area
    ax, ay = i8(xy[a, 0]), i8(xy[a, 1])
    bx, by = i8(xy[b, 0]), i8(xy[b, 1])
    cx, cy = i8(xy[c, 0]), i8(xy[c, 1])
    left, right = extent(xy[a, 0], xy[b, 0], xy[c, 0], depth.shape[1])
    px, py = left * SUBPIXEL + HALF, first * SUBPIXEL + HALF
    wa = (cx - bx) * (py - by) - (cy - by) * (px - bx)
    wb = (ax - cx) * (py - cy) - (ay - cy) * (px - cx)
    wc = (bx - ax) * (py - ay) - (by - ay) * (px - ax)
    steps = (by - cy) * SUBPIXEL, (cy - ay) * SUBPIXEL, (ay - by) * SUBPIXEL
    downs = (cx - bx) * SUBPIXEL, (ax - cx) * SUBPIXEL, (bx - ax) * SUBPIXEL
    whole = 1.0 / f8(area)
    near_b, near_c = (key[b] - key[a]) * whole, (key[c] - key[a]) * whole
    near = (
        key[a] + wb * near_b + wc * near_c,
        steps[1] * near_b + steps[2] * near_c,
        downs[1] * near_b + downs[2] * near_c,
    )
    edges = wa + _bias(cx - bx, cy - by), wb + _bias(ax - cx, ay - cy), wc + _bias(bx - ax, by - ay)
    scan = TriangleScan(first, last, left, right, edges, steps, downs, near)
    wide = max(ax, bx, cx) - min(ax, bx, cx) + LANES * SUBPIXEL
    if depth.shape[1] >= LANES and wide * (max(ay, by, cy) - min(ay, by, cy)) < _MOST:
        corners = f4(ax), f4(ay), f4(bx), f4(by), f4(cx), f4(cy)
        _fill_blocks(t, scan, corners, depth, ids, keep)
    else:
        _fill_rows(t, scan, depth, ids, keep)


@device("fast", inlined=True)
def _fill_blocks(
    t: int, scan: TriangleScan, corners: CornerPlaces, depth: Float32Array, ids: Int32Array, keep: bool
) -> None:
    """Draw the triangle in columns of LANES samples; in each column only the rows that it may reach."""
    first, last, left, right, edges, steps, downs, near = scan
    for column in range(left, right + 1, LANES):
        start, top, bottom = min(column, depth.shape[1] - LANES), first, last
        if right - left >= LANES:
            top, bottom = _rows_between(start, corners, first, last)
        x, y = start - left, top - first
        ea = i4(edges[0] + x * steps[0] + y * downs[0])
        eb = i4(edges[1] + x * steps[1] + y * downs[1])
        ec = i4(edges[2] + x * steps[2] + y * downs[2])
        k = near[0] + x * near[1] + y * near[2]
        across = i4(steps[0]), i4(steps[1]), i4(steps[2])
        for row in range(top, bottom + 1):
            if keep:
                cover(depth, ids, row, start, (ea, eb, ec), across, f4(k), f4(near[1]), i4(t))
            else:
                cover_depth(depth, row, start, (ea, eb, ec), across, f4(k), f4(near[1]))
            ea, eb, ec = i4(ea + downs[0]), i4(eb + downs[1]), i4(ec + downs[2])
            k += near[2]


@device("fast", inlined=True)
def fill_ribbon(
    xy: Int32Array,
    key: Float32Array,
    p: int,
    t: int,
    first: int,
    last: int,
    depth: Float32Array,
    ids: Int32Array,
) -> bool:
    """Draw the rows from `first` to `last` of a segment of a hair from vertex p on, triangles t and the next.

    Its depth is the first triangle's. Return False, and draw nothing, if it is not convex or very large.
    """
    corners = index(p), index(p + 1), index(p + 2), index(p + 3)
    area = area_of(xy, corners[0], corners[1], corners[2])
    side = 1 if area > 0 else -1
    if (
        side * area <= 0
        or side * area_of(xy, corners[1], corners[3], corners[2]) <= 0
        or side * area_of(xy, corners[0], corners[1], corners[3]) <= 0
        or side * area_of(xy, corners[0], corners[3], corners[2]) <= 0
    ):
        return False
    a, b, c, d = corners
    ax, ay, bx, by = i8(xy[a, 0]), i8(xy[a, 1]), i8(xy[b, 0]), i8(xy[b, 1])
    cx, cy, dx, dy = i8(xy[c, 0]), i8(xy[c, 1]), i8(xy[d, 0]), i8(xy[d, 1])
    low, high = min(ax, bx, cx, dx), max(ax, bx, cx, dx)
    tall = max(ay, by, cy, dy) - min(ay, by, cy, dy)
    if depth.shape[1] < LANES or (high - low + LANES * SUBPIXEL) * tall >= _MOST:
        return False
    left, right = extent(low, low, high, depth.shape[1])
    x, y = left * SUBPIXEL + HALF, first * SUBPIXEL + HALF
    e0, s0, d0 = _edge(side, ax, ay, bx, by, x, y)
    e1, s1, d1 = _edge(side, bx, by, dx, dy, x, y)
    e2, s2, d2 = _edge(side, dx, dy, cx, cy, x, y)
    e3, s3, d3 = _edge(side, cx, cy, ax, ay, x, y)
    e4, s4, d4 = _edge(side, bx, by, cx, cy, x, y)
    whole = 1.0 / f8(area)
    near_b, near_c = (key[b] - key[a]) * whole, (key[c] - key[a]) * whole
    over, under = (ax - cx) * (y - cy) - (ay - cy) * (x - cx), (bx - ax) * (y - ay) - (by - ay) * (x - ax)
    start = key[a] + over * near_b + under * near_c
    right_by = SUBPIXEL * ((cy - ay) * near_b + (ay - by) * near_c)
    down_by = SUBPIXEL * ((ax - cx) * near_b + (bx - ax) * near_c)
    steps = i4(s0), i4(s1), i4(s2), i4(s3), i4(s4)
    for column in range(left, right + 1, LANES):
        begin, top, bottom = min(column, depth.shape[1] - LANES), first, last
        if right - left >= LANES:
            one = _rows_between(begin, (f4(ax), f4(ay), f4(bx), f4(by), f4(cx), f4(cy)), first, last)
            other = _rows_between(begin, (f4(bx), f4(by), f4(dx), f4(dy), f4(cx), f4(cy)), first, last)
            top, bottom = min(one[0], other[0]), max(one[1], other[1])
        x, y = begin - left, top - first
        f0, f1, f2 = i4(e0 + x * s0 + y * d0), i4(e1 + x * s1 + y * d1), i4(e2 + x * s2 + y * d2)
        f3, diagonal = i4(e3 + x * s3 + y * d3), i4(e4 + x * s4 + y * d4)
        k = start + x * right_by + y * down_by
        for row in range(top, bottom + 1):
            cover_ribbon(
                depth, ids, row, begin, (f0, f1, f2, f3, diagonal), steps, f4(k), f4(right_by), i4(t)
            )
            f0, f1, f2 = i4(f0 + d0), i4(f1 + d1), i4(f2 + d2)
            f3, diagonal = i4(f3 + d3), i4(diagonal + d4)
            k += down_by
    return True


@device()
def _edge(side: int, px: int, py: int, qx: int, qy: int, x: int, y: int) -> tuple[int, int, int]:
    """Return the edge function of p to q at (x, y), with its bias, and its steps to the right and downwards.

    `side` is 1 if the corners run clockwise, else −1.
    """
    dx, dy = side * (qx - px), side * (qy - py)
    return dx * (y - py) - dy * (x - px) + _bias(dx, dy), -dy * SUBPIXEL, dx * SUBPIXEL


@device()
def _bias(dx: int, dy: int) -> int:
    """Return 0 for a top or left edge, whose samples belong to the triangle, and -1 for the others."""
    return 0 if dy < 0 or (dy == 0 and dx > 0) else -1


@device()
def _rows_between(start: int, corners: CornerPlaces, first: int, last: int) -> tuple[int, int]:
    """Return the rows in which a triangle may have samples in the LANES columns from `start` on."""
    low, high = f4((start - 1) * SUBPIXEL), f4((start + LANES) * SUBPIXEL)
    ax, ay, bx, by, cx, cy = corners
    (a0, a1), (b0, b1), (c0, c1) = (
        _heights(low, high, bx, by, cx, cy),
        _heights(low, high, cx, cy, ax, ay),
        _heights(low, high, ax, ay, bx, by),
    )
    # One row more at each end makes up for rounding.
    top = i8((min(a0, b0, c0) - f4(HALF)) * f4(1 / SUBPIXEL)) - 1
    bottom = i8((max(a1, b1, c1) - f4(HALF)) * f4(1 / SUBPIXEL)) + 1
    return max(top, first), min(bottom, last)


@device()
def _heights(low: float, high: float, px: float, py: float, qx: float, qy: float) -> tuple[float, float]:
    """Return the least and greatest y of an edge between two columns; for a vertical edge, y of one end."""
    left, right = min(px, qx), max(px, qx)
    if right < low or left > high:
        return _NEVER, -_NEVER
    slope = (qy - py) / (qx - px if qx != px else f4(1))
    one, other = py + (max(left, low) - px) * slope, py + (min(right, high) - px) * slope
    return min(one, other), max(one, other)


@device()
def _divide(w: int, step: int) -> tuple[int, int]:
    """Return floor(w / |step|) and the remainder; a step of 0 counts as 1.

    The division is exact enough: both are integers below 2⁴⁵, so a quotient that is not an integer differs
    from every integer by more than the rounding.
    """
    by = max(abs(step), i8(1))
    whole = i8(math.floor(w / f8(by)))
    return whole, w - whole * by


@device()
def _descend(whole: int, rest: int, more: int, over: int, step: int) -> tuple[int, int]:
    """Return quotient and remainder one row further down: add those of the increment."""
    whole, rest = whole + more, rest + over
    by = max(abs(step), i8(1))
    return (whole + 1, rest - by) if rest >= by else (whole, rest)


@device()
def _clip(whole: int, step: int, start: int, end: int) -> tuple[int, int]:
    """Shrink a range of whole i to those with w + step · i ≥ 0, where `whole` is floor(w / |step|)."""
    if step > 0:
        return max(start, -whole), end
    if step < 0:
        return start, min(end, whole)
    return start, end if whole >= 0 else i8(-1)


@device()
def _fill_rows(t: int, scan: TriangleScan, depth: Float32Array, ids: Int32Array, keep: bool) -> None:
    """Draw the triangle row by row, between its first and last sample in each row."""
    first, last, left, right, edges, steps, downs, near = scan
    (qa, ra), (da, ea) = _divide(edges[0], steps[0]), _divide(downs[0], steps[0])
    (qb, rb), (db, eb) = _divide(edges[1], steps[1]), _divide(downs[1], steps[1])
    (qc, rc), (dc, ec) = _divide(edges[2], steps[2]), _divide(downs[2], steps[2])
    begin = near[0]
    for y in range(first, last + 1):
        start, end = _clip(qa, steps[0], i8(0), right - left)
        start, end = _clip(qb, steps[1], start, end)
        start, end = _clip(qc, steps[2], start, end)
        k = begin + start * near[1]
        for x in range(left + start, left + end + 1):
            reached = f4(k)  # compared as stored, or a triangle drawn twice would win over itself
            if reached > depth[index(y), index(x)]:
                depth[index(y), index(x)] = reached
                if keep:
                    ids[index(y), index(x)] = t
            k += near[1]
        begin += near[2]
        qa, ra = _descend(qa, ra, da, ea, steps[0])
        qb, rb = _descend(qb, rb, db, eb, steps[1])
        qc, rc = _descend(qc, rc, dc, ec, steps[2])
