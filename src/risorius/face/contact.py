"""Contact of two facing surfaces that lie one above the other, such as the lips.

Each surface is a height over the (x, z) plane: the lowest y at a place for the upper one, the highest for the
lower one. A vertex of one surface meets the triangle of the other that covers its place. Unlike a search for
the nearest point, this cannot jump between faces or sides. Gaps open along y.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core.arrays import Array, BoolArray, Int32Array, Int64Array, IntArray
from ..core.kernels.jit import device, inlined, kernel

Grid = tuple[float, float, float, float]

COLUMNS, ROWS = 48, 32  # of cells, over x and z
ITEMS = 24  # triangles in cells, per vertex that may touch: more than lips have
EDGE = 1e-9  # share of a triangle; a point this little outside still belongs to it
SPILL = 1e-6  # share of a cell around a triangle that counts as covered: more than EDGE


class Facing(NamedTuple):
    """Two facing surfaces over one numbering of points.

    `vertices` (k,): those that may touch the other surface; `above` (k,): whether each belongs to the upper
    one; `upper`, `lower` (m, 3): triangles.
    """

    vertices: IntArray
    above: BoolArray
    upper: IntArray
    lower: IntArray


class Cells(NamedTuple):
    """Workspace for triangles sorted into cells of the (x, z) plane; it grows if it is too small.

    `span` (m, 4): each triangle's first and last column and row; `shape` (m, 8): its lowest height, x and z
    of its first corner and of the vectors to the second and third, and twice its area. A cell's `items` start
    and end at `start` (COLUMNS · ROWS + 1,), filled up to `fill`.
    """

    span: Int32Array
    shape: Array
    start: Int32Array
    fill: Int32Array
    items: IntArray

    @classmethod
    def allocate(cls, count: int) -> Cells:
        """Allocate for the triangles among `count` vertices."""
        start, fill = np.zeros(COLUMNS * ROWS + 1, np.int32), np.zeros(COLUMNS * ROWS + 1, np.int32)
        most = ITEMS * count
        return cls(np.zeros((most, 4), np.int32), np.zeros((most, 8)), start, fill, np.zeros(most, np.uint32))


class Contacts(NamedTuple):
    """Workspace for the contacts of one instant, at most one per vertex of `Facing`.

    The gap of row i is Σ weight[i] · y[points[i]]: `points` (k, 4), `weight` (k, 4), `gap` (k,) mm, negative
    if the surfaces overlap; `x` (k,): its place. `upper`, `lower`: their sorted triangles.
    """

    points: IntArray
    weight: Array
    gap: Array
    x: Array
    upper: Cells
    lower: Cells

    @classmethod
    def allocate(cls, count: int) -> Contacts:
        """Allocate for `count` contacts."""
        points, weight = np.zeros((count, 4), np.uint32), np.zeros((count, 4))
        return cls(
            points, weight, np.zeros(count), np.zeros(count), Cells.allocate(count), Cells.allocate(count)
        )


def find_contacts(facing: Facing, points: Array, reach: float, out: Contacts) -> int:
    """Write the contacts of `points` (n, 3) whose gap is below `reach` mm to `out`; return how many."""
    x, upper, lower = out.x, out.upper, out.lower
    return int(_find(*facing, points, reach, out.points, out.weight, out.gap, x, upper, lower))


@kernel
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
    upper_cells: Cells,
    lower_cells: Cells,
) -> int:
    grid = _grid_of(points)
    upper_start, upper_items, upper_shape = _sort_into_cells(points, upper, grid, 1.0, upper_cells)
    lower_start, lower_items, lower_shape = _sort_into_cells(points, lower, grid, -1.0, lower_cells)
    count = 0
    for k in range(len(vertices)):
        v = vertices[k]
        cell = _column(points[v, 0], grid) * ROWS + _row(points[v, 2], grid)
        if above[k]:
            sign, faces, shape = -1.0, lower, lower_shape
            start, items = lower_start, lower_items
        else:
            sign, faces, shape = 1.0, upper, upper_shape
            start, items = upper_start, upper_items
        t, y, wb, wc = _cover(v, sign, reach, points, faces, shape, items, start[cell], start[cell + 1])
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
def _grid_of(points: Array) -> Grid:
    """Return the least x and z of `points` (n, 3), and how many columns and rows go into one mm."""
    west, east, back, front = points[0, 0], points[0, 0], points[0, 2], points[0, 2]
    for p in points:
        west, east = min(west, p[0]), max(east, p[0])
        back, front = min(back, p[2]), max(front, p[2])
    return west, COLUMNS / max(east - west, 1e-6), back, ROWS / max(front - back, 1e-6)


@device
def _column(x: float, grid: Grid) -> int:
    return min(max(int((x - grid[0]) * grid[1]), 0), COLUMNS - 1)


@device
def _row(z: float, grid: Grid) -> int:
    return min(max(int((z - grid[2]) * grid[3]), 0), ROWS - 1)


@device
def _sort_into_cells(
    points: Array, triangles: IntArray, grid: Grid, sign: float, work: Cells
) -> tuple[IntArray, IntArray, Array]:
    """Return start (COLUMNS · ROWS + 1,) and items of the cells of the `grid`, and the triangles' shapes (m,
    8).

    The items of a cell are the triangles that meet it. The lowest height is the least `sign` times y.
    """
    span, shape, start, fill, items = work
    if len(span) < len(triangles):
        span, shape = np.empty((len(triangles), 4), np.int32), np.empty((len(triangles), 8))
    start[:] = 0
    room = SPILL / grid[3]
    for t in range(len(triangles)):
        a, b, c = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        _measure(points, a, b, c, sign, shape[t])
        span[t, 0] = _column(min(points[a, 0], points[b, 0], points[c, 0]), grid)
        span[t, 1] = _column(max(points[a, 0], points[b, 0], points[c, 0]), grid)
        span[t, 2] = _row(min(points[a, 2], points[b, 2], points[c, 2]) - room, grid)
        span[t, 3] = _row(max(points[a, 2], points[b, 2], points[c, 2]) + room, grid)
        for column in range(span[t, 0], span[t, 1] + 1):
            for cell in range(column * ROWS + span[t, 2], column * ROWS + span[t, 3] + 1):
                start[cell + 1] += 1
    for cell in range(COLUMNS * ROWS):
        start[cell + 1] += start[cell]
        fill[cell] = start[cell]
    if len(items) < start[COLUMNS * ROWS]:
        items = np.empty(start[COLUMNS * ROWS], np.uint32)
    for t in range(len(triangles)):
        for column in range(span[t, 0], span[t, 1] + 1):
            for cell in range(column * ROWS + span[t, 2], column * ROWS + span[t, 3] + 1):
                items[fill[cell]] = t
                fill[cell] += 1
    return start, items, shape


@inlined
def _measure(points: Array, a: int, b: int, c: int, sign: float, out: Array) -> None:
    """Write the shape (8,) of the triangle with the corners a, b, c; a flat one covers nothing."""
    x, z = points[a, 0], points[a, 2]
    ux, uz, vx, vz = points[b, 0] - x, points[b, 2] - z, points[c, 0] - x, points[c, 2] - z
    area = ux * vz - uz * vx
    lowest = min(sign * points[a, 1], sign * points[b, 1], sign * points[c, 1])
    out[0], out[1], out[2] = lowest if abs(area) >= EDGE else np.inf, x, z
    out[3], out[4], out[5], out[6], out[7] = ux, uz, vx, vz, area


@inlined
def _cover(
    v: int,
    sign: float,
    reach: float,
    points: Array,
    triangles: IntArray,
    shape: Array,
    items: IntArray,
    first: int,
    last: int,
) -> tuple[int, float, float, float]:
    """Return the triangle over vertex v with the lowest y (`sign` 1) or the highest (−1).

    Also returns `sign` times that y, and the weights of its last two corners; −1 if no triangle is nearer
    than `reach` along y. The search is over the `items` from `first` to `last`, with their `shape`.
    """
    x, z = points[v, 0], points[v, 2]
    nearest, best, weight_b, weight_c = -1, sign * points[v, 1] + reach, 0.0, 0.0
    for k in range(first, last):
        t = items[k]
        if shape[t, 0] >= best:
            continue
        px, pz = x - shape[t, 1], z - shape[t, 2]
        area = shape[t, 7]
        # Most triangles miss, and a quotient is slow: signs and sizes are enough.
        turn, size = np.copysign(1.0, area), abs(area)
        b, c = turn * (px * shape[t, 6] - pz * shape[t, 5]), turn * (shape[t, 3] * pz - shape[t, 4] * px)
        if b < -EDGE * size or c < -EDGE * size or b + c > (1.0 + EDGE) * size:
            continue
        p, q, r = triangles[t, 0], triangles[t, 1], triangles[t, 2]
        if v in (p, q, r):
            continue
        wb, wc = b / size, c / size
        y = sign * (points[p, 1] + wb * (points[q, 1] - points[p, 1]) + wc * (points[r, 1] - points[p, 1]))
        if y < best:
            nearest, best, weight_b, weight_c = t, y, wb, wc
    return nearest, best, weight_b, weight_c


@kernel
def narrowest(start: float, end: float, places: int, width: float, x: Array, gap: Array) -> Int64Array:
    """Return the contact with the narrowest gap around each of `places` even places from `start` to `end`.

    −1 if there is none. `width`: the share of the whole that counts as around a place; `x` mm and `gap` (k,):
    those of the contacts.
    """
    nearest = np.full(places, -1)
    step = (end - start) / (places - 1)
    reach = 0.5 * width * (places - 1)  # in steps
    for k in range(len(x)):
        place = (x[k] - start) / step
        for p in range(max(math.ceil(place - reach), 0), min(math.floor(place + reach), places - 1) + 1):
            if nearest[p] < 0 or gap[k] < gap[nearest[p]]:
                nearest[p] = k
    return nearest
