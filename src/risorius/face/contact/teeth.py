"""The teeth as an obstacle: lips and cheeks stay before them, the tongue stays behind or between them.

The front of a row (`tooth_row`) pushes the skin away, its back and its edges push the tongue; the lower row
is read in the frame of the jaw.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

from ...core.arrays import Array, IndexArray, IntArray, UInt32Array
from ...machine.kernels.jit import device, kernel
from ..head.head import Head
from ..muscles.fold_prevention import struts
from ..muscles.jaw import Jaw
from ..numerics.rotations import about_axis
from .tooth_row import NONE, ROUNDING, ROW, ToothRow, column_of, look_up, sector_of

CLEARANCE = 0.3  # mm of skin before the teeth's front
LAYERS = 0.75  # mm that the deepest skin gives up, so that layers keep their order: half at 1 mm of depth
BETWEEN = 0.1  # mm of skin before the teeth's front at the middle of a long edge
LONG, SHORT = 5.0, 4.0  # mm of an edge: a longer one keeps the whole clearance, a shorter one needs none
SPAN, SPAN_REACH = (
    3.0,
    10.0,
)  # mm at rest: the least length of an edge that can become so long, and to the teeth
DEEPEST, LOST = (
    7.0,
    10.0,
)  # mm behind the front: skin is pushed out in full up to the first, not beyond the second
LINING_REACH = 14.0  # mm from the teeth's vertices; skin that is nearer can meet them


@dataclass(frozen=True, slots=True)
class Teeth:
    """Both rows of a head, and the `places` (k, 2) of the level-1 skin that stay before them.

    A place is a vertex, twice, or the two ends of a long side or diagonal of a face, which could cut a tooth.
    """

    upper: ToothRow
    lower: ToothRow
    places: UInt32Array
    jaw: Jaw

    @classmethod
    @lru_cache(maxsize=4)
    def of(cls, head: Head) -> Teeth:
        """Measure the teeth of `head`."""
        rest = head.skin.matrix @ head.rest
        rows = (head.teeth_upper, head.teeth_lower)
        soft = head.skin.matrix @ np.maximum(head.masks["lips"], head.masks["inner_mouth"]) > 0.3
        front = max(mesh.vertices[:, 2].max() for mesh in rows)
        back = min(mesh.vertices[:, 2].min() for mesh in rows)
        near = (rest[:, 2] > back - LINING_REACH) & (rest[:, 2] < front + LINING_REACH)
        crowns = np.vstack([mesh.vertices[mesh.material < 0.5] for mesh in rows])
        lining = np.flatnonzero(soft & near)
        spans = _spans(rest, struts(head.skin.quads), lining, crowns)
        places = np.vstack([np.column_stack([lining, lining]), spans]).astype(np.uint32)
        return cls(
            ToothRow.of(head.teeth_upper, 1.0),
            ToothRow.of(head.teeth_lower, -1.0),
            places,
            Jaw.of(head),
        )

    def keep_out(self, skin: Array, opening: float) -> None:
        """Push the level-1 `skin` (N1, 4) before the teeth in place, with the jaw at `opening` 0..1."""
        for row, turn in self._rows(opening):
            _keep_out(skin, self.places, row.middle, row.front, row.around, turn, self.jaw.point)

    def keep_in(self, tongue: Array, opening: float) -> None:
        """Push the `tongue` (n, 3) behind the teeth, between them or before the lower ones, in place."""
        for row, turn in self._rows(opening):
            _keep_in(
                tongue, row.middle, row.front, row.back, row.around, row.edge, row.up, turn, self.jaw.point
            )

    def _rows(self, opening: float) -> tuple[tuple[ToothRow, Array], tuple[ToothRow, Array]]:
        return (self.upper, _UPRIGHT), (self.lower, about_axis(self.jaw.axis, self.jaw.angle * opening))


_UPRIGHT = np.eye(3)


def _spans(rest: Array, pairs: IntArray, lining: IndexArray, crowns: Array) -> IntArray:
    """Return those `pairs` (s, 2) of vertices in the `lining` that are long and near the `crowns` (c, 3)."""
    pairs = pairs[np.isin(pairs, lining).all(axis=1)]
    ends = rest[pairs]
    near = cKDTree(crowns).query(ends.mean(axis=1), distance_upper_bound=SPAN_REACH)[0] < SPAN_REACH
    return np.asarray(pairs[near & (np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) > SPAN)])


@device(inlined=True)
def _to_row(points: Array, v: int, turn: Array, hinge: Array) -> tuple[float, float, float]:
    """Return point v in the frame of a row that was turned by `turn` (3, 3) about `hinge`."""
    x, y, z = points[v, 0] - hinge[0], points[v, 1] - hinge[1], points[v, 2] - hinge[2]
    return (
        turn[0, 0] * x + turn[1, 0] * y + turn[2, 0] * z + hinge[0],
        turn[0, 1] * x + turn[1, 1] * y + turn[2, 1] * z + hinge[1],
        turn[0, 2] * x + turn[1, 2] * y + turn[2, 2] * z + hinge[2],
    )


@device(inlined=True)
def _from_row(x: float, y: float, z: float, turn: Array, hinge: Array, points: Array, v: int) -> None:
    x, y, z = x - hinge[0], y - hinge[1], z - hinge[2]
    for a in range(3):
        points[v, a] = turn[a, 0] * x + turn[a, 1] * y + turn[a, 2] * z + hinge[a]


@kernel("f8[:, :], u4[:, :], f8[:], f8[:, :], f8[:, :, :], f8[:, :], f8[:]")
def _keep_out(
    skin: Array, places: UInt32Array, middle: Array, front: Array, around: Array, turn: Array, hinge: Array
) -> None:
    last = front.shape[1] - 1.001
    for k in range(len(places)):
        a, b = places[k, 0], places[k, 1]
        clearance = CLEARANCE
        if a != b:
            x, y, z = skin[b, 0] - skin[a, 0], skin[b, 1] - skin[a, 1], skin[b, 2] - skin[a, 2]
            square = x * x + y * y + z * z
            if square < SHORT * SHORT:
                continue
            clearance = min(BETWEEN, np.sqrt(square) - LONG)
        ax, ay, az = _to_row(skin, a, turn, hinge)
        bx, by, bz = (ax, ay, az) if a == b else _to_row(skin, b, turn, hinge)
        x, row, out = 0.5 * (ax + bx), (0.5 * (ay + by) - middle[1]) / ROW, 0.5 * (az + bz) - middle[0]
        far, beyond = np.sqrt(x * x + out * out), max(0.0, -row, row - front.shape[1] + 1.0)
        row = min(max(row, 0.0), last)
        offset = clearance - ROUNDING * beyond - far
        sector, j = sector_of(x, out), int(row)
        if around[sector, j, 1] + offset <= 0.0 or around[sector, j, 0] + offset >= LOST:
            continue
        depth = look_up(front, column_of(x, out), row) + offset
        if depth <= 0.0 or depth >= LOST:
            continue
        if a == b:
            depth -= LAYERS * depth / (depth + 1.0)
        push = depth * min(1.0, (LOST - depth) / (LOST - DEEPEST)) / max(far, CLEARANCE)
        _from_row(ax + push * x, ay, az + push * out, turn, hinge, skin, a)
        _from_row(bx + push * x, by, bz + push * out, turn, hinge, skin, b)


@kernel("f8[:, :], f8[:], f8[:, :], f8[:, :], f8[:, :, :], f8[:], f8, f8[:, :], f8[:]")
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
        if radius < max(around[sector_of(x, out), nearest, 2], 1.0):
            continue
        column = column_of(x, out)
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
