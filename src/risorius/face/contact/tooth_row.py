"""A row of teeth as tables over the height and the angle around the middle of its arch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from ...core.arrays import Array, IndexArray
from ...machine.kernels.jit import device
from ..head.head import TeethMesh

ANGLES, HALF_TURN = 91, 2.2  # columns of the tables, and the radians that they span on either side
ROW = 0.8  # mm of height of a row of the tables
BORDER = 3  # rows beyond the teeth
ROUNDING = 3.0  # mm by which each row beyond the edge recedes, so that skin meets no step
WIDENED = 5  # columns by which the front is widened, because faces of skin lie between their corners
SAMPLES = 6  # along each side of a triangle
AHEAD = 6.0  # mm from the hindmost tooth to the middle, so that the last tooth has a back
SECTORS = 24  # of a full turn
NONE = 1e3  # mm: the back of a row without teeth


@dataclass(frozen=True, slots=True)
class ToothRow:
    """A row of teeth as tables.

    `middle`: z and lowest y; `front` and `back` (ANGLES, rows): mm from the middle; `edge` (ANGLES,): the
    height of the cutting edge; `up`: 1 for the upper row, −1 for the lower one; `around` (SECTORS, rows, 3):
    a coarser table that needs no angle, with the least and the largest front and the least back of a sector,
    neighbouring rows included.
    """

    middle: Array
    front: Array
    back: Array
    edge: Array
    up: float
    around: Array

    @classmethod
    def of(cls, teeth: TeethMesh, up: float) -> Self:
        """Measure the row `teeth`."""
        crowns = teeth.vertices[teeth.material < 0.5]
        middle = np.array([crowns[:, 2].min() + AHEAD, crowns[:, 1].min() - BORDER * ROW])
        points = _samples(teeth)
        angle, radius = _polar(points, middle[0])
        rows = int((crowns[:, 1].max() - middle[1]) / ROW) + BORDER + 2
        cell = (angle, np.rint((points[:, 1] - middle[1]) / ROW).astype(int))
        front, back = np.zeros((ANGLES, rows)), np.full((ANGLES, rows), NONE)
        np.maximum.at(front, cell, radius)
        np.minimum.at(back, cell, radius)
        edge = np.full(ANGLES, NONE * up)
        (np.minimum if up > 0.0 else np.maximum).at(edge, _polar(crowns, middle[0])[0], crowns[:, 1])
        front = _largest(_rounded(front), WIDENED, axis=0)
        edge = -up * _largest(-up * edge, 3)
        back = -_largest(_largest(-back, 3, axis=0), 3)
        return cls(middle, front, back, edge, up, _around(front, back))


def _samples(mesh: TeethMesh) -> Array:
    """Return points (n, 3) all over the teeth of `mesh`, without the gums."""
    crowns = mesh.triangles[(mesh.material[mesh.triangles] < 0.5).all(axis=1)]
    share = np.linspace(0.0, 1.0, SAMPLES)
    first, second = (w.ravel() for w in np.meshgrid(share, share))
    inside = first + second <= 1.0
    weights = np.stack([1.0 - first - second, first, second], axis=1)[inside]
    return np.asarray((weights @ mesh.vertices[crowns]).reshape(-1, 3))


def _polar(points: Array, middle: float) -> tuple[IndexArray, Array]:
    """Return the column (n,) and the distance (n,) of points (n, 3) around the `middle` z of an arch."""
    out = points[:, 2] - middle
    column = np.rint((np.arctan2(points[:, 0], out) / HALF_TURN + 1.0) * 0.5 * (ANGLES - 1)).astype(int)
    return np.clip(column, 0, ANGLES - 1), np.hypot(points[:, 0], out)


def _rounded(front: Array) -> Array:
    """Return the table, with rows that recede evenly beyond the teeth."""
    result = front.copy()
    for way in (1, -1):
        for row in range(1, front.shape[1]):
            here, before = (row, row - 1) if way > 0 else (-1 - row, -row)
            result[:, here] = np.maximum(result[:, here], result[:, before] - ROUNDING)
    return np.maximum(result, 0.0)


def _around(front: Array, back: Array) -> Array:
    """Return the table `around` (SECTORS, rows, 3) of a row's `front` and `back` (ANGLES, rows)."""
    angle = np.linspace(-np.pi, np.pi, 16 * SECTORS)
    x, out = np.sin(angle), np.cos(angle)
    sector = np.array([sector_of(*place) for place in zip(x, out, strict=True)])
    column = _polar(np.stack([x, np.zeros_like(x), out], axis=1), 0.0)[0]
    # One more column on either side, because places are interpolated between two columns.
    inside = [
        np.unique(np.clip(column[sector == s, None] + (-1, 0, 1), 0, ANGLES - 1)) for s in range(SECTORS)
    ]
    extremes = [(front[i].min(axis=0), front[i].max(axis=0), back[i].min(axis=0)) for i in inside]
    least, largest, hindmost = (np.stack(table) for table in zip(*extremes, strict=True))
    return np.stack([-_largest(-least, 3), _largest(largest, 3), -_largest(-hindmost, 3)], axis=-1)


def _largest(table: Array, count: int, axis: int = -1) -> Array:
    """Return the largest of the `count` entries around each along an axis, whose ends go on as they are.

    The same as SciPy's filters, without the time of their import.
    """
    ends = [(0, 0)] * table.ndim
    ends[axis] = (count // 2, count // 2)
    return np.asarray(sliding_window_view(np.pad(table, ends, mode="edge"), count, axis=axis).max(axis=-1))


@device()
def sector_of(x: float, out: float) -> int:
    """Return the sector, 0 to SECTORS − 1, of the direction (x, out): even steps about a square, no angle."""
    reach = abs(x) + abs(out)
    along = x / reach if reach > 0.0 else 0.0
    if out < 0.0:
        along = (2.0 if x > 0.0 else -2.0) - along
    return int(min(max((along + 2.0) * 0.25 * SECTORS, 0.0), SECTORS - 1.0))


@device()
def column_of(x: float, out: float) -> float:
    """Return the column, with a fraction, of the direction (x, out) in the tables of ANGLES columns."""
    angle = np.arctan2(x, out) / HALF_TURN
    return float(min(max((angle + 1.0) * 0.5 * (ANGLES - 1), 0.0), ANGLES - 1.001))


@device(inlined=True)
def look_up(table: Array, column: float, row: float) -> float:
    """Return the value of `table` (ANGLES, rows) between its entries; `row` lies within them."""
    i, j = int(column), int(row)
    s, t = column - i, row - j
    low = (1.0 - s) * table[i, j] + s * table[i + 1, j]
    high = (1.0 - s) * table[i, j + 1] + s * table[i + 1, j + 1]
    return float((1.0 - t) * low + t * high)
