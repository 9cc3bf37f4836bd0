"""Contact of two facing surfaces that lie one above the other, such as the lips.

Each surface is a height over the (x, z) plane: the lowest y at a place for the upper one, the highest for the
lower one. A vertex of one surface meets the triangle of the other that covers its place. Unlike a search for
the nearest point, this cannot jump between faces or sides. Gaps open along y.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np

from ...core.arrays import Array, BoolArray, Int32Array, IntArray
from ...machine.kernels.jit import device, i8, kernel
from ..numerics.fours import LANES

Grid = tuple[float, float, float, float]

COLUMNS, ROWS = 48, 32  # of cells, over x and z
EDGE = 1e-9  # share of a triangle; a point this little outside still belongs to it
SPILL = 1e-6  # share of a cell around a triangle that counts as covered: more than EDGE
_CELLS = COLUMNS * ROWS
_EVERY_LANE = (1 << LANES) - 1


class Facing(NamedTuple):
    """Two facing surfaces over one numbering of points.

    `vertices` (k,): those that may touch the other surface; `above` (k,): whether each belongs to the upper
    one; `upper`, `lower` (m, 3): triangles.
    """

    vertices: IntArray
    above: BoolArray
    upper: IntArray
    lower: IntArray


class Places(NamedTuple):
    """Workspace for vertices sorted into cells of the (x, z) plane: first those below, then those above.

    The vertices of a cell stand at `start[cell]:start[cell + 1]`; `highest` (2 · COLUMNS,) is the largest
    bound in each column of cells. `slot` (k,) is the place of each vertex in this order. In this order:
    `vertex` its number, `x`, `z` (k + 3,), `nearest` its nearest triangle, −1 for none, and `found`
    (k, 3) the least height found, or a bound for it, and the weights of the triangle's last two corners.
    """

    start: Annotated[Int32Array, "i4[:]"]
    highest: Annotated[Array, "f8[:]"]
    slot: Annotated[Int32Array, "i4[:]"]
    vertex: Annotated[IntArray, "u4[:]"]
    x: Annotated[Array, "f8[:]"]
    z: Annotated[Array, "f8[:]"]
    nearest: Annotated[Int32Array, "i4[:]"]
    found: Annotated[Array, "f8[:, :]"]

    @classmethod
    def allocate(cls, count: int) -> Places:
        """Allocate for `count` vertices."""
        start, slot, nearest = (np.zeros(size, np.int32) for size in (2 * _CELLS + 2, count, count))
        x, z = np.zeros(count + LANES - 1), np.zeros(count + LANES - 1)
        vertex = np.zeros(count, np.uint32)
        return cls(start, np.zeros(2 * COLUMNS), slot, vertex, x, z, nearest, np.zeros((count, 3)))


class Contacts(NamedTuple):
    """Workspace for the contacts of one instant, at most one per vertex of `Facing`.

    The gap of row i is Σ weight[i] · y[points[i]]: `points` (k, 4), `weight` (k, 4), `gap` (k,) mm, negative
    if the surfaces overlap; `x` (k,): its place. `places`: the sorted vertices.
    """

    points: Annotated[IntArray, "u4[:, :]"]
    weight: Annotated[Array, "f8[:, :]"]
    gap: Annotated[Array, "f8[:]"]
    x: Annotated[Array, "f8[:]"]
    places: Places

    @classmethod
    def allocate(cls, count: int) -> Contacts:
        """Allocate for `count` contacts."""
        points, weight = np.zeros((count, 4), np.uint32), np.zeros((count, 4))
        return cls(points, weight, np.zeros(count), np.zeros(count), Places.allocate(count))


def find_contacts(facing: Facing, points: Array, reach: float, out: Contacts) -> int:
    """Write the contacts of `points` (n, 3) whose gap is below `reach` mm to `out`; return how many."""
    return int(_find(*facing, points, reach, out.points, out.weight, out.gap, out.x, out.places))


@kernel("i4[:], b1[:], i4[:, :], i4[:, :], f8[:, :], f8, u4[:, :], f8[:, :], f8[:], f8[:], Places -> i8")
def _find(
    vertices: IntArray,
    above: BoolArray,
    upper: IntArray,
    lower: IntArray,
    points: Array,
    reach: float,
    out_points: IntArray,
    out_weight: Array,
    out_gap: Array,
    out_x: Array,
    places: Places,
) -> int:
    grid = _grid_of(points)
    _sort_into_cells(points, vertices, above, reach, grid, places)
    for side in range(2):
        sign, faces = (-1.0, lower) if side else (1.0, upper)
        for t in range(len(faces)):
            _cover(t, side, sign, points, faces, grid, places)
    count = 0
    for k in range(len(vertices)):
        s, v = places.slot[k], vertices[k]
        t, y, wb, wc = places.nearest[s], places.found[s, 0], places.found[s, 1], places.found[s, 2]
        if t < 0:
            continue
        sign, faces = (-1.0, lower) if above[k] else (1.0, upper)
        out_points[count, 0], out_weight[count, 0] = v, -sign
        out_points[count, 1], out_weight[count, 1] = faces[t, 0], sign * (1.0 - wb - wc)
        out_points[count, 2], out_weight[count, 2] = faces[t, 1], sign * wb
        out_points[count, 3], out_weight[count, 3] = faces[t, 2], sign * wc
        out_gap[count], out_x[count] = y - sign * points[v, 1], points[v, 0]
        count += 1
    return count


@device()
def _grid_of(points: Array) -> Grid:
    """Return the least x and z of `points` (n, 3), and how many columns and rows go into one mm."""
    west, east, back, front = points[0, 0], points[0, 0], points[0, 2], points[0, 2]
    for p in range(len(points)):
        west, east = min(west, points[p, 0]), max(east, points[p, 0])
        back, front = min(back, points[p, 2]), max(front, points[p, 2])
    return west, COLUMNS / max(east - west, 1e-6), back, ROWS / max(front - back, 1e-6)


@device()
def _column(x: float, grid: Grid) -> int:
    return min(max(int((x - grid[0]) * grid[1]), 0), COLUMNS - 1)


@device()
def _row(z: float, grid: Grid) -> int:
    return min(max(int((z - grid[2]) * grid[3]), 0), ROWS - 1)


@device()
def _sort_into_cells(
    points: Array, vertices: IntArray, above: BoolArray, reach: float, grid: Grid, places: Places
) -> None:
    start, highest, slot, found = places.start, places.highest, places.slot, places.found
    for cell in range(len(start)):
        start[cell] = 0
    for column in range(len(highest)):
        highest[column] = -np.inf
    for k in range(len(vertices)):
        v, side = vertices[k], i8(above[k])
        column = _column(points[v, 0], grid)
        slot[k] = side * _CELLS + column * ROWS + _row(points[v, 2], grid)
        # One cell too far: filling the cells moves each start to the next.
        start[slot[k] + 2] += 1
        column += side * COLUMNS
        highest[column] = max(highest[column], _bound(points[v, 1], side, reach))
    for cell in range(2 * _CELLS):
        start[cell + 1] += start[cell]
    for k in range(len(vertices)):
        v, cell = vertices[k], slot[k] + 1
        s = start[cell]
        start[cell] += 1
        slot[k], places.vertex[s], places.nearest[s] = s, v, -1
        places.x[s], places.z[s] = points[v, 0], points[v, 2]
        found[s, 0] = _bound(points[v, 1], i8(above[k]), reach)


@device()
def _bound(y: float, side: int, reach: float) -> float:
    """Return below which height, or above which as a negative number, a triangle is not within `reach` mm."""
    return (-y if side else y) + reach


@device(inlined=True)
def _cover(
    t: int, side: int, sign: float, points: Array, triangles: IntArray, grid: Grid, places: Places
) -> None:
    """Give triangle t to the vertices of a `side` that it covers: the lowest (`sign` 1) or highest (−1).

    A flat one covers nothing.
    """
    p, q, r = triangles[t, 0], triangles[t, 1], triangles[t, 2]
    x, z, room = points[p, 0], points[p, 2], SPILL / grid[3]
    west = _column(min(x, points[q, 0], points[r, 0]), grid)
    east = _column(max(x, points[q, 0], points[r, 0]), grid)
    lowest = min(sign * points[p, 1], sign * points[q, 1], sign * points[r, 1])
    near = False
    for column in range(side * COLUMNS + west, side * COLUMNS + east + 1):
        near |= lowest < places.highest[column]
    ux, uz, vx, vz = points[q, 0] - x, points[q, 2] - z, points[r, 0] - x, points[r, 2] - z
    area = ux * vz - uz * vx
    turn, size = np.copysign(1.0, area), abs(area)
    if not near or size < EDGE:
        return
    back = _row(min(z, points[q, 2], points[r, 2]) - room, grid)
    front = _row(max(z, points[q, 2], points[r, 2]) + room, grid)
    edge = 2.0 * EDGE * size
    for column in range(west, east + 1):
        cell = side * _CELLS + column * ROWS
        last = places.start[cell + front + 1]
        for first in range(places.start[cell + back], last, LANES):
            missed = 0
            for lane in range(LANES):
                px, pz = places.x[first + lane] - x, places.z[first + lane] - z
                b, c = turn * (px * vz - pz * vx), turn * (ux * pz - uz * px)
                missed |= i8((-b > edge) | (-c > edge) | (b + c > size + edge)) << lane
            if missed == _EVERY_LANE:
                continue
            for s in range(first, min(first + LANES, last)):
                if not missed >> (s - first) & 1 and lowest < places.found[s, 0]:
                    _meet(s, t, sign, points, triangles, places)


@device()
def _meet(s: int, t: int, sign: float, points: Array, triangles: IntArray, places: Places) -> None:
    """Give triangle t to the vertex in place s if it covers it, with a height below the least so far."""
    v, p, q, r = places.vertex[s], triangles[t, 0], triangles[t, 1], triangles[t, 2]
    x, z = points[p, 0], points[p, 2]
    px, pz = places.x[s] - x, places.z[s] - z
    ux, uz, vx, vz = points[q, 0] - x, points[q, 2] - z, points[r, 0] - x, points[r, 2] - z
    area = ux * vz - uz * vx
    turn, size = np.copysign(1.0, area), abs(area)
    b, c = turn * (px * vz - pz * vx), turn * (ux * pz - uz * px)
    if b < -EDGE * size or c < -EDGE * size or b + c > (1.0 + EDGE) * size or v in (p, q, r):
        return
    wb, wc = b / size, c / size
    y = sign * (points[p, 1] + wb * (points[q, 1] - points[p, 1]) + wc * (points[r, 1] - points[p, 1]))
    if y < places.found[s, 0]:
        places.found[s, 0], places.found[s, 1], places.found[s, 2], places.nearest[s] = y, wb, wc, t


@kernel("Contacts, i8, f8, (f8, f8), f8, f8[:, :], f8, i4[:], f8[:] -> i8")
def keep_tight(
    contacts: Contacts,
    count: int,
    near: float,
    bounds: tuple[float, float],
    slack: float,
    ends: Array,
    width: float,
    nearest: Int32Array,
    high: Array,
) -> int:
    """Keep of the first `count` contacts those that are narrower than `near` mm or must be; return how many.

    A gap must not be below the first of the `bounds` (mm), and the narrowest one about each place between
    `ends` (2, 4) not above the second, if that is finite (see `narrowest`); `high` (k,) is written, the
    upper bound of each gap that is kept. If no gap is out of its bounds by more than `slack`, none is kept.
    """
    low, widest = bounds
    for k in range(count):
        high[k] = np.inf
    if widest < np.inf:
        narrowest(ends[0, 0], ends[1, 0], width, contacts.x, contacts.gap, count, nearest)
        for p in range(len(nearest)):
            if nearest[p] >= 0:
                high[nearest[p]] = widest
    kept, wrong = 0, False
    for k in range(count):
        gap = contacts.gap[k]
        wrong |= gap < low - slack or gap > high[k] + slack
        if gap < near or high[k] < np.inf:
            contacts.gap[kept], high[kept] = gap, high[k]
            for a in range(4):
                contacts.points[kept, a] = contacts.points[k, a]
                contacts.weight[kept, a] = contacts.weight[k, a]
            kept += 1
    return kept if wrong else 0


@device()
def narrowest(
    start: float, end: float, width: float, x: Array, gap: Array, count: int, nearest: Int32Array
) -> None:
    """Write the contact with the narrowest gap about each even place from `start` to `end` to `nearest`.

    −1 for none. `width`: the share of the whole that counts as around a place; `x` mm and `gap`:
    those of the `count` contacts.
    """
    places = len(nearest)
    for p in range(places):
        nearest[p] = -1
    step = (end - start) / (places - 1)
    reach = 0.5 * width * (places - 1)  # in steps
    for k in range(count):
        place = (x[k] - start) / step
        for p in range(max(math.ceil(place - reach), 0), min(math.floor(place + reach), places - 1) + 1):
            if nearest[p] < 0 or gap[k] < gap[nearest[p]]:
                nearest[p] = k
