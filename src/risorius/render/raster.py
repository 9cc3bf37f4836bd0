"""The visibility buffer: which triangle each sample of the picture shows.

Positions are snapped to 1/256 sample and edges are tested in integers, so coverage is exact: a sample on an
edge that two triangles share belongs to exactly one of them (the top-left rule). The result depends on the
order of the triangles alone. Samples are drawn band by band: a band's rows stay in the processor's cache
until they are shaded.
"""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from .jit import exact, exact_kernel, f4, f8, i8, index, inlined

SUBPIXEL = 256
_HALF = SUBPIXEL // 2
CHUNK = 64  # triangles whose joint extent is tested at once
BAND = 64  # rows of samples drawn at once

IntArray = npt.NDArray[np.int32]
FloatArray = npt.NDArray[np.float32]
ByteArray = npt.NDArray[np.uint8]


class Visibility:
    """Buffers for drawing up to a given number of triangles.

    After `draw`, `ids` (height, width) int32 holds the index of the triangle that each sample shows or -1,
    and `depth` (height, width) float32 its key: larger is nearer, 0 is empty. After `prepare`, `rows` and
    `chunks` tell `rasterize` where to look for what.
    """

    def __init__(self, width: int, height: int, triangles: int, *, keep_ids: bool = True) -> None:
        self.depth: FloatArray = np.zeros((height, width), np.float32)
        self.ids: IntArray = np.full((height, width) if keep_ids else (1, 1), -1, np.int32)
        self.rows: IntArray = np.zeros((triangles, 2), np.int32)
        self.chunks: IntArray = np.zeros((-(-triangles // CHUNK), 2), np.int32)

    def draw(self, xy: IntArray, key: FloatArray, triangles: IntArray, two_sided: ByteArray) -> None:
        """Clear the buffers and draw.

        `xy` (n, 2) int32 are positions in 1/256 sample, x to the right and y down, the centre of the first
        sample at (128, 128); `key` (n,) float32 is positive, larger nearer, and affine in the picture (the
        reciprocal of the distance is); `triangles` (m, 3) int32 appear counter-clockwise when seen from
        the front; `two_sided` (m,) uint8 is 1 where the back is drawn too.
        """
        if len(triangles) != len(self.rows):
            raise ValueError(f"{len(triangles)} triangles for a buffer of {len(self.rows)}")
        self.prepare(xy, triangles, two_sided)
        rasterize_all(xy, key, triangles, self.rows, self.chunks, self.depth, self.ids)

    def prepare(self, xy: IntArray, triangles: IntArray, two_sided: ByteArray) -> None:
        """Find the rows that the triangles cover (see `draw`)."""
        find_rows(xy, triangles, two_sided, self.depth.shape[0], self.depth.shape[1], self.rows, self.chunks)


@exact
def _area(xy: IntArray, a: int, b: int, c: int) -> int:
    """Twice the signed area: positive where the corners run clockwise in the picture (y down)."""
    abx = i8(xy[b, 0]) - i8(xy[a, 0])
    aby = i8(xy[b, 1]) - i8(xy[a, 1])
    acx = i8(xy[c, 0]) - i8(xy[a, 0])
    acy = i8(xy[c, 1]) - i8(xy[a, 1])
    return abx * acy - aby * acx


@exact
def _extent(p: int, q: int, r: int, limit: int) -> tuple[int, int]:
    """Return the first and last sample whose centre lies between the least and the greatest coordinate."""
    first = (min(p, q, r) - _HALF + SUBPIXEL - 1) // SUBPIXEL
    last = (max(p, q, r) - _HALF) // SUBPIXEL
    return max(first, 0), min(last, limit - 1)


@exact_kernel
def find_rows(
    xy: IntArray,
    triangles: IntArray,
    two_sided: ByteArray,
    height: int,
    width: int,
    rows: IntArray,
    chunks: IntArray,
) -> None:
    """Write the first and last row of each triangle (first > last: not drawn) and of each chunk."""
    for chunk in range(len(chunks)):
        low, high = height, -1
        for t in range(chunk * CHUNK, min((chunk + 1) * CHUNK, len(triangles))):
            a, b, c = index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])
            area = _area(xy, a, b, c)
            first, last = _extent(xy[a, 1], xy[b, 1], xy[c, 1], height)
            left, right = _extent(xy[a, 0], xy[b, 0], xy[c, 0], width)
            if area == 0 or (area > 0 and two_sided[t] == 0) or left > right or first > last:
                first, last = height, -1
            rows[t, 0], rows[t, 1] = first, last
            low, high = min(low, first), max(high, last)
        chunks[chunk, 0], chunks[chunk, 1] = low, high


@exact_kernel
def rasterize_all(
    xy: IntArray,
    key: FloatArray,
    triangles: IntArray,
    rows: IntArray,
    chunks: IntArray,
    depth: FloatArray,
    ids: IntArray,
) -> None:
    """Draw all triangles, all rows."""
    for top in range(0, depth.shape[0], BAND):
        rasterize(xy, key, triangles, rows, chunks, top, min(top + BAND, depth.shape[0]), depth, ids)


@exact
def rasterize(
    xy: IntArray,
    key: FloatArray,
    triangles: IntArray,
    rows: IntArray,
    chunks: IntArray,
    top: int,
    bottom: int,
    depth: FloatArray,
    ids: IntArray,
) -> None:
    """Draw the rows from `top` to `bottom`; a later triangle wins only where it is strictly nearer."""
    keep = ids.shape[0] == depth.shape[0]
    depth[top:bottom] = f4(0)
    if keep:
        ids[top:bottom] = -1
    for chunk in range(len(chunks)):
        if chunks[chunk, 0] >= bottom or chunks[chunk, 1] < top:
            continue
        for t in range(chunk * CHUNK, min((chunk + 1) * CHUNK, len(triangles))):
            first, last = max(rows[t, 0], top), min(rows[t, 1], bottom - 1)
            if first <= last:
                _fill(xy, key, triangles, t, first, last, depth, ids, keep)


@exact
def _bias(dx: int, dy: int) -> int:
    """Return 0 for a top or left edge, whose samples belong to the triangle, and -1 for the others."""
    return 0 if dy < 0 or (dy == 0 and dx > 0) else -1


@exact
def _divide(w: int, step: int) -> tuple[int, int]:
    """Return floor(w / |step|) and what remains; a step of 0 counts as 1.

    The division is exact enough: both are integers below 2⁴⁵, so a quotient that is no integer differs from
    every integer by more than the rounding.
    """
    by = max(abs(step), i8(1))
    whole = i8(math.floor(w / f8(by)))
    return whole, w - whole * by


@exact
def _descend(whole: int, rest: int, more: int, over: int, step: int) -> tuple[int, int]:
    """Return quotient and remainder one row further down, where the dividend has grown by theirs."""
    whole, rest = whole + more, rest + over
    by = max(abs(step), i8(1))
    return (whole + 1, rest - by) if rest >= by else (whole, rest)


@exact
def _clip(whole: int, step: int, start: int, end: int) -> tuple[int, int]:
    """Shrink a range of whole i to those with w + step · i ≥ 0, where `whole` is floor(w / |step|)."""
    if step > 0:
        return max(start, -whole), end
    if step < 0:
        return start, min(end, whole)
    return start, end if whole >= 0 else i8(-1)


@inlined
def _fill(
    xy: IntArray,
    key: FloatArray,
    triangles: IntArray,
    t: int,
    first: int,
    last: int,
    depth: FloatArray,
    ids: IntArray,
    keep: bool,
) -> None:
    """Draw the rows from `first` to `last` of triangle t."""
    a, b, c = index(triangles[t, 0]), index(triangles[t, 1]), index(triangles[t, 2])
    area = _area(xy, a, b, c)
    if area < 0:
        b, c, area = c, b, -area
    ax, ay = i8(xy[a, 0]), i8(xy[a, 1])
    bx, by = i8(xy[b, 0]), i8(xy[b, 1])
    cx, cy = i8(xy[c, 0]), i8(xy[c, 1])
    left, right = _extent(xy[a, 0], xy[b, 0], xy[c, 0], depth.shape[1])
    bias_a, bias_b, bias_c = _bias(cx - bx, cy - by), _bias(ax - cx, ay - cy), _bias(bx - ax, by - ay)
    step_a, step_b, step_c = (by - cy) * SUBPIXEL, (cy - ay) * SUBPIXEL, (ay - by) * SUBPIXEL
    whole = 1.0 / f8(area)
    near_b, near_c = (key[b] - key[a]) * whole, (key[c] - key[a]) * whole
    key_step = step_b * near_b + step_c * near_c
    px, py = left * SUBPIXEL + _HALF, first * SUBPIXEL + _HALF
    wa = (cx - bx) * (py - by) - (cy - by) * (px - bx) + bias_a
    wb = (ax - cx) * (py - cy) - (ay - cy) * (px - cx) + bias_b
    wc = (bx - ax) * (py - ay) - (by - ay) * (px - ax) + bias_c
    down_a, down_b, down_c = (cx - bx) * SUBPIXEL, (ax - cx) * SUBPIXEL, (bx - ax) * SUBPIXEL
    (qa, ra), (qb, rb), (qc, rc) = _divide(wa, step_a), _divide(wb, step_b), _divide(wc, step_c)
    (da, ea), (db, eb), (dc, ec) = _divide(down_a, step_a), _divide(down_b, step_b), _divide(down_c, step_c)
    wb, wc = wb - bias_b, wc - bias_c
    for y in range(first, last + 1):
        start, end = _clip(qa, step_a, i8(0), right - left)
        start, end = _clip(qb, step_b, start, end)
        start, end = _clip(qc, step_c, start, end)
        k = key[a] + wb * near_b + wc * near_c + start * key_step
        for x in range(left + start, left + end + 1):
            near = f4(k)  # compared as stored, or a triangle drawn twice would win over itself
            if near > depth[index(y), index(x)]:
                depth[index(y), index(x)] = near
                if keep:
                    ids[index(y), index(x)] = t
            k += key_step
        wb, wc = wb + down_b, wc + down_c
        qa, ra = _descend(qa, ra, da, ea, step_a)
        qb, rb = _descend(qb, rb, db, eb, step_b)
        qc, rc = _descend(qc, rc, dc, ec, step_c)
