"""Compression of the skin, region by region: one kernel for wrinkles and bulges.

A quad's deformation is read from its two diagonals, because a mirrored mesh has the same ones; the triangles
of a split quad would not be mirrored.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ...core.arrays import AnyArray, Array, IndexArray, UInt32Array, UIntArray
from ...machine.array_cache import cached_arrays
from ...machine.kernels.jit import device, kernel
from ..head.face_coordinates import smooth
from ..head.head import Head
from ..numerics.sparse import short

STRETCHED = 1.05  # a larger stretch does not compensate for compression beside it
_ROUNDS = 2  # of smoothing on level 0
_MIDDLE = 9.0  # mm from the middle, within which the two sides blend
_ALONG = 1e-6  # a direction projected into a quad has at least this length
_NEGLIGIBLE = 4e-3  # a quad with a smaller share of a vertex's strain is left out


class Zone(NamedTuple):
    """A region: `mask` (N1,) 0..1 at level 1, and the unit direction `pull` (Q0, 3) at the quads of level 0.

    The compression is measured along that direction; if it is 0, the compression of the area is measured.
    """

    mask: Array
    pull: Array


@dataclass(frozen=True, slots=True)
class Compression:
    """Rows of (vertex, zone) with the quads that each reads.

    `quad` (e, 4) and `frame` (e, 3): the quads in use, one entry per zone, with the coefficients of the
    zone's direction on their diagonals (0 to measure area) and the area at rest; `side` (e, 2): their shares
    in the means of the left and right half of their zone `zone` (e,); `start` (r + 1,), `column`, `weight`:
    the entries that each row averages; `row_zone` (r,), `row_vertex` (r,), `row_side` (r,): zone, vertex, and
    share of the left half; `work`: the strain (e,) and the means (zones, 2) of the last measurement; `taut`:
    whether skin that is stretched across a direction may narrow along it.
    """

    zones: int
    work: tuple[Array, Array]
    taut: bool
    quad: UInt32Array
    frame: Array
    zone: UInt32Array
    side: Array
    start: UInt32Array
    column: UIntArray
    weight: Array
    row_zone: UInt32Array
    row_vertex: UInt32Array
    row_side: Array

    @classmethod
    def of(cls, head: Head, zones: Sequence[Zone], *, taut: bool = False) -> Compression:
        """Prepare to measure `zones` of a head; `taut` for skin that folds, not for flesh that swells."""
        inputs: list[AnyArray] = [head.rest, head.quads, *(z.mask for z in zones), *(z.pull for z in zones)]
        tables = cached_arrays("compression", inputs, lambda: _tables(head, zones))
        return cls(len(zones), _workspace(len(tables[0]), len(zones)), taut, *tables)

    def anew(self) -> Compression:
        """Return the same tables with a workspace of their own."""
        return replace(self, work=_workspace(len(self.quad), self.zones))

    def measure(self, skin: Array, out: Array) -> Array:
        """Write the stretch (r,), 1 at rest, of every row on level-0 `skin` (N0, 4) to `out`, and return it.

        Half of it is the row's own and half the mean of its side of the zone: skin slides on the fat below.
        """
        _measure(
            *self.work,
            self.taut,
            self.quad,
            self.frame,
            self.zone,
            self.side,
            self.start,
            self.column,
            self.weight,
            self.row_zone,
            self.row_side,
            skin,
            out,
        )
        return out


def _workspace(entries: int, zones: int) -> tuple[Array, Array]:
    return np.empty(entries), np.empty((zones, 2))


def _tables(head: Head, zones: Sequence[Zone]) -> tuple[AnyArray, ...]:
    """Return the tables of a `Compression`, from `quad` to `row_side`."""
    spread = _quads_to_fine(head)
    left = smooth(-_MIDDLE, _MIDDLE, head.rest[head.quads].mean(axis=1)[:, 0])
    fine_left = smooth(-_MIDDLE, _MIDDLE, (head.skin.matrix @ head.rest)[:, 0])
    parts = [_part(head, spread, zone, left) for zone in zones]
    rows = sp.block_diag([p.rows for p in parts], format="csr")
    vertices = np.concatenate([p.vertices for p in parts])
    return (
        np.concatenate([head.quads[p.quads] for p in parts]).astype(np.uint32),
        np.concatenate([p.frame for p in parts]),
        np.repeat(np.arange(len(parts)), [len(p.quads) for p in parts]).astype(np.uint32),
        np.concatenate([p.side for p in parts]),
        rows.indptr.astype(np.uint32),
        short(rows.indices),
        rows.data.astype(np.float64),
        np.repeat(np.arange(len(parts)), [len(p.vertices) for p in parts]).astype(np.uint32),
        vertices.astype(np.uint32),
        fine_left[vertices],
    )


class _Part(NamedTuple):
    quads: IndexArray
    frame: Array
    side: Array
    rows: sp.csr_matrix
    vertices: IndexArray


def _part(head: Head, spread: sp.csr_matrix, zone: Zone, left: Array) -> _Part:
    vertices = np.flatnonzero(zone.mask > 0.0)
    rows = spread[vertices]
    rows = sp.diags(1.0 / np.asarray(rows.sum(axis=1)).ravel()) @ rows
    rows.data[rows.data < _NEGLIGIBLE] = 0.0
    rows.eliminate_zeros()
    rows = (sp.diags(1.0 / np.asarray(rows.sum(axis=1)).ravel()) @ rows).tocsr()
    quads = np.unique(rows.indices)
    corners = head.rest[head.quads[quads]]
    share = _at_quads(head, zone.mask)[quads] * _areas(corners)
    sides = np.stack([share * left[quads], share * (1.0 - left[quads])], axis=1)
    return _Part(
        quads, _frames(corners, zone.pull[quads]), sides / sides.sum(axis=0), rows[:, quads], vertices
    )


def _quads_to_fine(head: Head) -> sp.csr_matrix:
    """Return the matrix (N1, Q0) from values of quads to smoothed values of level-1 vertices."""
    quads, count = head.quads, len(head.rest)
    owner = np.repeat(np.arange(len(quads)), 4)
    area = _areas(head.rest[quads])
    gather = sp.csr_matrix((area[owner], (quads.ravel(), owner)), shape=(count, len(quads)))
    sides = np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2)
    beside = sp.csr_matrix((np.ones(len(sides)), (sides[:, 0], sides[:, 1])), shape=(count, count))
    beside = ((beside + beside.T) > 0).astype(float)
    smoothing = 0.5 * (sp.identity(count) + _averaging(beside))
    spread = _averaging(gather)
    for _ in range(_ROUNDS):
        spread = smoothing @ spread
    return (head.skin.matrix @ spread).tocsr()


def _averaging(matrix: sp.csr_matrix) -> sp.csr_matrix:
    return sp.diags(1.0 / np.asarray(matrix.sum(axis=1)).ravel()) @ matrix


def _at_quads(head: Head, mask: Array) -> Array:
    """Return a level-1 mask (N1,) at the middles of level-0 quads (Q0,): their face points."""
    return mask[len(mask) - len(head.quads) :]


def _areas(corners: Array) -> Array:
    return np.asarray(np.linalg.norm(np.cross(*_diagonals(corners)), axis=1))


def _diagonals(corners: Array) -> tuple[Array, Array]:
    return corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]


def _frames(corners: Array, pull: Array) -> Array:
    """Return the frames (k, 3) of quads.

    The first two numbers are the coefficients on the diagonals of `pull` (k, 3), projected into the quad as a
    unit vector, or 0 and 0 without such a direction; the third is the area at rest.
    """
    a, b = _diagonals(corners)
    aa, bb, ab = (a * a).sum(axis=1), (b * b).sum(axis=1), (a * b).sum(axis=1)
    determinant = aa * bb - ab**2
    pa, pb = (pull * a).sum(axis=1), (pull * b).sum(axis=1)
    u, v = (pa * bb - pb * ab) / determinant, (pb * aa - pa * ab) / determinant
    length = np.linalg.norm(u[:, None] * a + v[:, None] * b, axis=1)
    directed = length > _ALONG
    unit = np.where(directed[:, None], np.stack([u, v], axis=1) / np.maximum(length, _ALONG)[:, None], 0.0)
    return np.column_stack([unit, np.sqrt(determinant)])


@device(inlined=True)
def _stretch(skin: Array, quad: UInt32Array, frame: Array, e: int, taut: bool) -> float:
    """Return the stretch of quad e along its frame's direction, or of its area.

    `taut`: skin that is stretched across that direction narrows without compression, and only skin that is
    shorter than that is compressed: an open jaw stretches the cheeks and folds nothing.
    """
    p, q, r, s = quad[e, 0], quad[e, 1], quad[e, 2], quad[e, 3]
    ax, ay, az = skin[r, 0] - skin[p, 0], skin[r, 1] - skin[p, 1], skin[r, 2] - skin[p, 2]
    bx, by, bz = skin[s, 0] - skin[q, 0], skin[s, 1] - skin[q, 1], skin[s, 2] - skin[q, 2]
    x, y, z = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
    area = np.sqrt(x * x + y * y + z * z) / frame[e, 2]
    u, v = frame[e, 0], frame[e, 1]
    if u == 0.0 and v == 0.0:
        return float(area)
    x, y, z = u * ax + v * bx, u * ay + v * by, u * az + v * bz
    along = np.sqrt(x * x + y * y + z * z)
    if taut and along < min(area, 1.0):
        along = min(np.sqrt(along * area), 1.0)
    return float(along)


@kernel(
    "f8[:], f8[:, :], b1, u4[:, :], f8[:, :], u4[:], f8[:, :], u4[:], "
    "u2[:], f8[:], u4[:], f8[:], f8[:, :], f8[:]",
    "f8[:], f8[:, :], b1, u4[:, :], f8[:, :], u4[:], f8[:, :], u4[:], "
    "u4[:], f8[:], u4[:], f8[:], f8[:, :], f8[:]",
    arithmetic="sums",
)
def _measure(
    strain: Array,
    mean: Array,
    taut: bool,
    quad: UInt32Array,
    frame: Array,
    zone: UInt32Array,
    side: Array,
    start: UInt32Array,
    column: UIntArray,
    weight: Array,
    row_zone: UInt32Array,
    row_side: Array,
    skin: Array,
    out: Array,
) -> None:
    mean[:] = 0.0
    for e in range(len(quad)):
        strain[e] = _stretch(skin, quad, frame, e, taut)
        low = min(strain[e], STRETCHED)
        mean[zone[e], 0] += side[e, 0] * low
        mean[zone[e], 1] += side[e, 1] * low
    for r in range(len(out)):
        own = 0.0
        for k in range(start[r], start[r + 1]):
            own += weight[k] * strain[column[k]]
        left, right = mean[row_zone[r], 0], mean[row_zone[r], 1]
        out[r] = 0.5 * own + 0.5 * (right + row_side[r] * (left - right))
