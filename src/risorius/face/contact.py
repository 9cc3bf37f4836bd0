"""Contact of two facing surfaces that lie one above the other, such as the lips.

Each surface is a height over the (x, z) plane: of the upper one counts the lowest y at a place, of the lower
one the highest. A vertex of one meets the other where a triangle covers its place. Unlike a search for the
nearest point, this cannot flip faces or change its mind about the side. Gaps open along y.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .jit import compiled, device, inlined

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.integer]

BINS = 96
ITEMS = 16  # in bins, for each vertex that may touch: more than lips have
EDGE = 1e-9  # of a triangle, beyond it, that still belongs to it
SPILL = 1e-6  # of a triangle's extent, beyond it, that is looked at: more than EDGE


class Facing(NamedTuple):
    """Two facing surfaces over one numbering of points.

    `vertices` (k,) are those that may touch the other surface, `above` (k,) whether each belongs to the upper
    one; `upper`, `lower` (m, 3) triangles.
    """

    vertices: IntArray
    above: npt.NDArray[np.bool_]
    upper: IntArray
    lower: IntArray


class Bins(NamedTuple):
    """Workspace for triangles sorted by x: each one's first and last bin `span` (m, 2), where a bin's items
    `start` and are to `fill` (BINS + 1,), `items` and their `box` (i, 3). More are made room for when needed.
    """

    span: npt.NDArray[np.int32]
    start: npt.NDArray[np.int32]
    fill: npt.NDArray[np.int32]
    items: IntArray
    box: Array

    @classmethod
    def room_for(cls, count: int) -> Bins:
        """Allocate for the triangles among `count` vertices."""
        start, fill = np.zeros(BINS + 1, np.int32), np.zeros(BINS + 1, np.int32)
        items = ITEMS * count
        return cls(
            np.zeros((items, 2), np.int32), start, fill, np.zeros(items, np.uint32), np.zeros((items, 3))
        )


class Contacts(NamedTuple):
    """Workspace for the contacts of one instant, at most one per vertex of `Facing`.

    Row i says that Σ weight[i] · y[points[i]] is the gap: `points` (k, 4), `weight` (k, 4), `gap` (k,) mm
    (negative where the surfaces overlap), `x` (k,) where it lies. `upper`, `lower`: their sorted triangles.
    """

    points: IntArray
    weight: Array
    gap: Array
    x: Array
    upper: Bins
    lower: Bins

    @classmethod
    def room_for(cls, count: int) -> Contacts:
        """Allocate for `count` contacts."""
        points, weight = np.zeros((count, 4), np.uint32), np.zeros((count, 4))
        return cls(
            points, weight, np.zeros(count), np.zeros(count), Bins.room_for(count), Bins.room_for(count)
        )


def find_contacts(facing: Facing, points: Array, reach: float, out: Contacts) -> int:
    """Write the contacts of `points` (n, 3) whose gap is below `reach` mm to `out`; return how many."""
    x, upper, lower = out.x, out.upper, out.lower
    return int(_find(*facing, points, reach, out.points, out.weight, out.gap, x, upper, lower))


@compiled
def _find(
    vertices: IntArray,
    above: npt.NDArray[np.bool_],
    upper: IntArray,
    lower: IntArray,
    points: Array,
    reach: float,
    out_points: IntArray,
    out_weight: Array,
    out_gap: Array,
    out_x: Array,
    upper_bins: Bins,
    lower_bins: Bins,
) -> int:
    low, width = _range_of(points)
    upper_start, upper_items, upper_box = _sort_into_bins(points, upper, low, width, 1.0, upper_bins)
    lower_start, lower_items, lower_box = _sort_into_bins(points, lower, low, width, -1.0, lower_bins)
    count = 0
    for k in range(len(vertices)):
        v = vertices[k]
        k_bin = min(max(int((points[v, 0] - low) / width), 0), BINS - 1)
        if above[k]:
            sign, faces, box = -1.0, lower, lower_box
            start, items = lower_start, lower_items
        else:
            sign, faces, box = 1.0, upper, upper_box
            start, items = upper_start, upper_items
        t, y, wb, wc = _cover(v, sign, reach, points, faces, box, items, start[k_bin], start[k_bin + 1])
        if t < 0:
            continue
        out_points[count, 0], out_weight[count, 0] = v, -sign
        out_points[count, 1], out_weight[count, 1] = faces[t, 0], sign * (1.0 - wb - wc)
        out_points[count, 2], out_weight[count, 2] = faces[t, 1], sign * wb
        out_points[count, 3], out_weight[count, 3] = faces[t, 2], sign * wc
        out_gap[count], out_x[count] = y - sign * points[v, 1], points[v, 0]
        count += 1
    return count


@device
def _range_of(points: Array) -> tuple[float, float]:
    low, high = points[0, 0], points[0, 0]
    for p in points:
        low, high = min(low, p[0]), max(high, p[0])
    return low, max(high - low, 1e-6) / BINS


@device
def _sort_into_bins(
    points: Array,
    triangles: IntArray,
    low: float,
    width: float,
    sign: float,
    work: Bins,
) -> tuple[IntArray, IntArray, Array]:
    """Return start (BINS + 1,) and items: the triangles that meet each bin of `width` mm from x = `low`.

    And the box (items, 3) of every item: least `sign` times y, least and largest z.
    """
    bins, start, fill, items, box = work
    if len(bins) < len(triangles):
        bins = np.empty((len(triangles), 2), np.int32)
    start[:] = 0
    for t in range(len(triangles)):
        a, b, c = points[triangles[t, 0], 0], points[triangles[t, 1], 0], points[triangles[t, 2], 0]
        bins[t, 0] = min(max(int((min(a, b, c) - low) / width), 0), BINS - 1)
        bins[t, 1] = min(max(int((max(a, b, c) - low) / width), 0), BINS - 1)
        for k in range(bins[t, 0], bins[t, 1] + 1):
            start[k + 1] += 1
    for k in range(BINS):
        start[k + 1] += start[k]
        fill[k] = start[k]
    if len(items) < start[BINS]:
        items, box = np.empty(start[BINS], np.uint32), np.empty((start[BINS], 3))
    for t in range(len(triangles)):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        lowest = min(sign * points[a, 1], sign * points[b, 1], sign * points[c, 1])
        back = min(points[a, 2], points[b, 2], points[c, 2])
        front = max(points[a, 2], points[b, 2], points[c, 2])
        room = SPILL * (front - back)
        for k in range(bins[t, 0], bins[t, 1] + 1):
            items[fill[k]] = t
            box[fill[k], 0], box[fill[k], 1], box[fill[k], 2] = lowest, back - room, front + room
            fill[k] += 1
    return start, items, box


@inlined
def _cover(
    v: int,
    sign: float,
    reach: float,
    points: Array,
    triangles: IntArray,
    box: Array,
    items: IntArray,
    first: int,
    last: int,
) -> tuple[int, float, float, float]:
    """Return the triangle over vertex v with the lowest y (`sign` 1) or the highest (−1), `sign` times that
    y, and the weights of its last two corners; −1 where none is nearer than `reach` along y.

    `box` tells beforehand which of the `items` from `first` to `last` cannot be that triangle.
    """
    x, z = points[v, 0], points[v, 2]
    found, best, weight_b, weight_c = -1, sign * points[v, 1] + reach, 0.0, 0.0
    for k in range(first, last):
        if box[k, 0] >= best or z < box[k, 1] or z > box[k, 2]:
            continue
        t = items[k]
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        if v in (a, b, c):
            continue
        ux, uz = points[b, 0] - points[a, 0], points[b, 2] - points[a, 2]
        vx, vz = points[c, 0] - points[a, 0], points[c, 2] - points[a, 2]
        area = ux * vz - uz * vx
        if abs(area) < EDGE:
            continue
        px, pz = x - points[a, 0], z - points[a, 2]
        wb, wc = (px * vz - pz * vx) / area, (ux * pz - uz * px) / area
        if wb < -EDGE or wc < -EDGE or wb + wc > 1.0 + EDGE:
            continue
        y = sign * (points[a, 1] + wb * (points[b, 1] - points[a, 1]) + wc * (points[c, 1] - points[a, 1]))
        if y < best:
            found, best, weight_b, weight_c = t, y, wb, wc
    return found, best, weight_b, weight_c


@compiled
def narrowest(
    start: float, end: float, places: int, width: float, x: Array, gap: Array
) -> npt.NDArray[np.int64]:
    """Return the contact with the narrowest gap about each of `places` even places from `start` to `end`.

    −1 where there is none. `width` is the share of the whole within which a contact is about a place; `x` mm
    and `gap` (k,) are those of the contacts.
    """
    found = np.full(places, -1)
    step = (end - start) / (places - 1)
    reach = 0.5 * width * (places - 1)  # in steps
    for k in range(len(x)):
        place = (x[k] - start) / step
        for p in range(max(math.ceil(place - reach), 0), min(math.floor(place + reach), places - 1) + 1):
            if found[p] < 0 or gap[k] < gap[found[p]]:
                found[p] = k
    return found
