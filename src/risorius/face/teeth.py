"""The teeth as an obstacle: lips and cheeks stay before them, the tongue behind or between them.

A row of teeth is read as a table over the angle about the middle of its arch and the height: how far out its
front and its back stand. Its front is kept from the skin, its back and its edges from the tongue; the lower
row is looked up in the frame of the jaw.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
import numpy.typing as npt
from scipy.ndimage import maximum_filter, maximum_filter1d, minimum_filter

from .head import Head, Mesh
from .jaw import Jaw
from .jit import compiled, inlined
from .rotations import about_axis

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.uint32]

ANGLES, HALF_TURN = 91, 2.2  # columns of the tables, and the radians to either side of the middle they span
ROW = 0.8  # mm of height of a row of the tables
BORDER = 3  # rows beyond the teeth
ROUNDING = 3.0  # mm by which a row recedes with each row beyond its edge: no step for skin to fall over
WIDENED = 5  # columns over which the front is widened: faces of skin lie between their corners
SAMPLES = 6  # along each side of a triangle
CLEARANCE = 0.3  # mm of skin before the teeth's front
FINE, COARSE = 3.0, 0.14  # mm of an edge of the skin above which its corners stand further out, and how much
DEEPEST, LOST = 7.0, 10.0  # mm behind the front: up to here skin is pushed out, from there on it is elsewhere
LINING_REACH = 14.0  # mm from the teeth's vertices to the skin that can meet them
AHEAD = 6.0  # mm from the hindmost tooth to the middle: the last tooth has a back to go round
SECTORS = 24  # of a full turn
NONE = 1e3  # mm: where a row has no back


@dataclass(frozen=True, slots=True)
class Row:
    """A row of teeth as tables: `middle` (z, lowest y), `front` and `back` (ANGLES, rows) mm from the middle,
    and the height `edge` (ANGLES,) of its cutting edge; `up` is 1 for the upper row, −1 for the lower one.
    `around` (SECTORS, rows, 3) is a coarser table that costs no angle: the least and the largest front and
    the least back in a sector, beside its row too.
    """

    middle: Array
    front: Array
    back: Array
    edge: Array
    up: float
    around: Array

    @classmethod
    def of(cls, teeth: Mesh, up: float) -> Self:
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
        front = maximum_filter1d(_rounded(front), WIDENED, axis=0, mode="nearest")
        edge = -up * maximum_filter1d(-up * edge, 3, mode="nearest")
        back = minimum_filter(back, 3, mode="nearest")
        return cls(middle, front, back, edge, up, _around(front, back))


def _samples(mesh: Mesh) -> Array:
    """Return points (n, 3) all over the teeth, not the gums, of `mesh`."""
    crowns = mesh.triangles[(mesh.material[mesh.triangles] < 0.5).all(axis=1)]
    share = np.linspace(0.0, 1.0, SAMPLES)
    first, second = (w.ravel() for w in np.meshgrid(share, share))
    inside = first + second <= 1.0
    weights = np.stack([1.0 - first - second, first, second], axis=1)[inside]
    return np.asarray((weights @ mesh.vertices[crowns]).reshape(-1, 3))


def _polar(points: Array, middle: float) -> tuple[npt.NDArray[np.intp], Array]:
    """Return the column (n,) and the distance (n,) of points (n, 3) about the `middle` z of an arch."""
    out = points[:, 2] - middle
    column = np.rint((np.arctan2(points[:, 0], out) / HALF_TURN + 1.0) * 0.5 * (ANGLES - 1)).astype(int)
    return np.clip(column, 0, ANGLES - 1), np.hypot(points[:, 0], out)


def _rounded(front: Array) -> Array:
    """Return the table with rows that recede evenly where there is nothing."""
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
    sector = np.array([_sector(*place) for place in zip(x, out, strict=True)])
    column = _polar(np.stack([x, np.zeros_like(x), out], axis=1), 0.0)[0]
    # With a column to either side: the outermost places are looked up between two columns.
    inside = [
        np.unique(np.clip(column[sector == s, None] + (-1, 0, 1), 0, ANGLES - 1)) for s in range(SECTORS)
    ]
    extremes = [(front[i].min(axis=0), front[i].max(axis=0), back[i].min(axis=0)) for i in inside]
    least, largest, hindmost = (np.stack(table) for table in zip(*extremes, strict=True))
    size = (1, 3)
    return np.stack(
        [
            minimum_filter(least, size, mode="nearest"),
            maximum_filter(largest, size, mode="nearest"),
            minimum_filter(hindmost, size, mode="nearest"),
        ],
        axis=-1,
    )


@dataclass(frozen=True, slots=True)
class Teeth:
    """Both rows of a head, the level-1 vertices `lining` (k,) of the skin that can meet them, and the mm
    `clearance` (k,) that each is kept before them.
    """

    upper: Row
    lower: Row
    lining: IntArray
    clearance: Array
    jaw: Jaw

    @classmethod
    def of(cls, head: Head) -> Self:
        """Measure the teeth of `head`."""
        rest = head.skin.matrix @ head.rest
        soft = head.skin.matrix @ np.maximum(head.masks["lips"], head.masks["inner_mouth"]) > 0.3
        front = max(mesh.vertices[:, 2].max() for mesh in (head.teeth_upper, head.teeth_lower))
        back = min(mesh.vertices[:, 2].min() for mesh in (head.teeth_upper, head.teeth_lower))
        near = (rest[:, 2] > back - LINING_REACH) & (rest[:, 2] < front + LINING_REACH)
        lining = np.flatnonzero(soft & near).astype(np.uint32)
        upper, lower = Row.of(head.teeth_upper, 1.0), Row.of(head.teeth_lower, -1.0)
        return cls(upper, lower, lining, _clearance(rest, head.skin.quads)[lining], Jaw.of(head))

    def keep_out(self, skin: Array, opening: float) -> None:
        """Push the level-1 `skin` (N1, 3) before the teeth in place, with the jaw at `opening` 0..1."""
        for row, turn in self._rows(opening):
            _keep_out(
                skin, self.lining, self.clearance, row.middle, row.front, row.around, turn, self.jaw.point
            )

    def keep_in(self, tongue: Array, opening: float) -> None:
        """Push the `tongue` (n, 3) behind the teeth, between them or before the lower ones, in place."""
        for row, turn in self._rows(opening):
            _keep_in(
                tongue, row.middle, row.front, row.back, row.around, row.edge, row.up, turn, self.jaw.point
            )

    def _rows(self, opening: float) -> tuple[tuple[Row, Array], tuple[Row, Array]]:
        return (self.upper, _UPRIGHT), (self.lower, about_axis(self.jaw.axis, self.jaw.angle * opening))


_UPRIGHT = np.eye(3)


def _clearance(rest: Array, quads: npt.NDArray[np.int32]) -> Array:
    """Return the clearance (n,) in mm of the skin's vertices: between its corners a long edge cuts the round
    of a tooth, as the cheeks' do at the molars.
    """
    longest = np.zeros(len(rest))
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        length = np.linalg.norm(rest[quads[:, a]] - rest[quads[:, b]], axis=1)
        for end in (a, b):
            np.maximum.at(longest, quads[:, end], length)
    return np.asarray(CLEARANCE + COARSE * np.maximum(longest - FINE, 0.0))


@compiled
def _sector(x: float, out: float) -> int:
    """Return the sector, 0 to SECTORS − 1, of the direction (x, out): even steps about a square, no angle."""
    reach = abs(x) + abs(out)
    along = x / reach if reach > 0.0 else 0.0
    if out < 0.0:
        along = (2.0 if x > 0.0 else -2.0) - along
    return int(min(max((along + 2.0) * 0.25 * SECTORS, 0.0), SECTORS - 1.0))


@inlined
def _to_row(points: Array, v: int, turn: Array, hinge: Array) -> tuple[float, float, float]:
    """Return point v in the frame of a row that was turned by `turn` (3, 3) about `hinge`."""
    x, y, z = points[v, 0] - hinge[0], points[v, 1] - hinge[1], points[v, 2] - hinge[2]
    return (
        turn[0, 0] * x + turn[1, 0] * y + turn[2, 0] * z + hinge[0],
        turn[0, 1] * x + turn[1, 1] * y + turn[2, 1] * z + hinge[1],
        turn[0, 2] * x + turn[1, 2] * y + turn[2, 2] * z + hinge[2],
    )


@inlined
def _from_row(x: float, y: float, z: float, turn: Array, hinge: Array, points: Array, v: int) -> None:
    x, y, z = x - hinge[0], y - hinge[1], z - hinge[2]
    for a in range(3):
        points[v, a] = turn[a, 0] * x + turn[a, 1] * y + turn[a, 2] * z + hinge[a]


@compiled
def _column(x: float, out: float) -> float:
    angle = np.arctan2(x, out) / HALF_TURN
    return float(min(max((angle + 1.0) * 0.5 * (ANGLES - 1), 0.0), ANGLES - 1.001))


@inlined
def _look_up(table: Array, column: float, row: float) -> float:
    """Return the value of `table` (ANGLES, rows) between its entries; `row` lies within them."""
    i, j = int(column), int(row)
    s, t = column - i, row - j
    low = (1.0 - s) * table[i, j] + s * table[i + 1, j]
    high = (1.0 - s) * table[i, j + 1] + s * table[i + 1, j + 1]
    return float((1.0 - t) * low + t * high)


@compiled
def _keep_out(
    skin: Array,
    vertices: IntArray,
    clearance: Array,
    middle: Array,
    front: Array,
    around: Array,
    turn: Array,
    hinge: Array,
) -> None:
    last = front.shape[1] - 1.001
    for k in range(len(vertices)):
        v = vertices[k]
        x, y, z = _to_row(skin, v, turn, hinge)
        row, out = (y - middle[1]) / ROW, z - middle[0]
        far, beyond = np.sqrt(x * x + out * out), max(0.0, -row, row - front.shape[1] + 1.0)
        row = min(max(row, 0.0), last)
        offset = clearance[k] - ROUNDING * beyond - far
        sector, j = _sector(x, out), int(row)
        if around[sector, j, 1] + offset <= 0.0 or around[sector, j, 0] + offset >= LOST:
            continue
        depth = _look_up(front, _column(x, out), row) + offset
        if depth <= 0.0 or depth >= LOST:
            continue
        push = 1.0 + depth * min(1.0, (LOST - depth) / (LOST - DEEPEST)) / max(far, CLEARANCE)
        _from_row(push * x, y, push * out + middle[0], turn, hinge, skin, v)


@compiled
def _keep_in(
    tongue: Array,
    middle: Array,
    front: Array,
    back: Array,
    around: Array,
    edge: Array,
    up: float,
    turn: Array,
    hinge: Array,
) -> None:
    for v in range(len(tongue)):
        x, y, z = _to_row(tongue, v, turn, hinge)
        out = z - middle[0]
        radius = np.sqrt(x * x + out * out)
        nearest = round(min(max((y - middle[1]) / ROW, 0.0), back.shape[1] - 1.0))
        if radius < max(around[_sector(x, out), nearest, 2], 1.0):
            continue
        column = _column(x, out)
        i, s = int(column), column - int(column)
        beyond = up * (y - ((1.0 - s) * edge[i] + s * edge[i + 1]))
        behind = radius - min(back[i, nearest], back[i + 1, nearest])
        before = max(front[i, nearest], front[i + 1, nearest]) - radius if up < 0.0 else NONE
        if beyond <= 0.0 or behind <= 0.0 or before <= 0.0:
            continue
        if beyond < min(behind, before):
            y -= up * beyond
        elif before < behind:
            x, out = x + before * x / radius, out + before * out / radius
        else:
            x, out = x - behind * x / radius, out - behind * out / radius
        _from_row(x, y, out + middle[0], turn, hinge, tongue, v)
