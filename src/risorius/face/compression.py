"""How much the skin is compressed, region by region: one kernel for wrinkles and bulges.

A quad's deformation is read from its two diagonals, which a mirrored mesh has too (triangles of a split quad
are not mirrored by the split).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from ..core.arrays import Array, IndexArray, UInt32Array, UIntArray
from ..core.kernels.jit import inlined, summing_kernel
from .head import Head
from .marks import smooth
from .products import short

STRETCHED = 1.05  # stretch beyond this does not make up for compression beside it
_ROUNDS = 2  # of smoothing on level 0
_MIDDLE = 9.0  # mm from the middle within which the two sides pass into each other
_ALONG = 1e-6  # length of a direction laid into a quad below which there is none
_NEGLIGIBLE = 4e-3  # share of a vertex's strain below which a quad is left out


class Zone(NamedTuple):
    """A region at level 1: `mask` (N1,) 0..1, and at the quads of level 0 the unit direction `pull` (Q0, 3)
    along which the skin is measured; where that is 0 the area is measured.
    """

    mask: Array
    pull: Array


@dataclass(frozen=True, slots=True)
class Compression:
    """Rows of (vertex, zone) with the quads that each reads.

    `quad` (e, 4) and `frame` (e, 3) are the quads in use, one entry per zone, with the coefficients of the
    zone's direction on their diagonals, 0 where area is measured, and the area at rest; `side` (e, 2) their
    shares in the means of the left and right half of their zone `zone` (e,); `start` (r + 1,), `column`,
    `weight` the entries that each row averages; `row_zone` (r,), `row_vertex` (r,), `row_side` (r,) share of
    the left half; `work` the strain (e,) and the means (zones, 2) of what was measured last; `taut`
    whether skin drawn out across a direction may narrow along it.
    """

    zones: int
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
    work: tuple[Array, Array]
    taut: bool

    @classmethod
    def of(cls, head: Head, zones: Sequence[Zone], *, taut: bool = False) -> Compression:
        """Prepare to measure `zones` of a head; `taut` as skin that folds, not as flesh that swells."""
        spread = _quads_to_fine(head)
        left = smooth(-_MIDDLE, _MIDDLE, head.rest[head.quads].mean(axis=1)[:, 0])
        fine_left = smooth(-_MIDDLE, _MIDDLE, (head.skin.matrix @ head.rest)[:, 0])
        parts = [_part(head, spread, zone, left) for zone in zones]
        sizes = [len(p.quads) for p in parts]
        rows = sp.block_diag([p.rows for p in parts], format="csr")
        vertices = np.concatenate([p.vertices for p in parts])
        return cls(
            len(zones),
            np.concatenate([head.quads[p.quads] for p in parts]).astype(np.uint32),
            np.concatenate([p.frame for p in parts]),
            np.repeat(np.arange(len(parts)), sizes).astype(np.uint32),
            np.concatenate([p.side for p in parts]),
            rows.indptr.astype(np.uint32),
            short(rows.indices),
            rows.data.astype(np.float64),
            np.repeat(np.arange(len(parts)), [len(p.vertices) for p in parts]).astype(np.uint32),
            vertices.astype(np.uint32),
            fine_left[vertices],
            (np.empty(sum(sizes)), np.empty((len(zones), 2))),
            taut,
        )

    def measure(self, skin: Array, out: Array) -> Array:
        """Write the stretch (r,), 1 at rest, of every row on level-0 `skin` (N0, 3) to `out`, and return it.

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
    """Return for quads their frame (k, 3): the coefficients on the diagonals of `pull` (k, 3), laid into the
    quad, as a unit vector, or 0 and 0 where there is no such direction; and the area at rest.
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


@inlined
def _stretch(skin: Array, quad: UInt32Array, frame: Array, e: int, taut: bool) -> float:
    """Return the stretch of quad e along its frame's direction, or of its area.

    `taut`: skin that is drawn out across that direction narrows by itself, and only what is shorter than
    that is compressed: an open jaw draws the cheeks long and folds nothing.
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


@summing_kernel
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
