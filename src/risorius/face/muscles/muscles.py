"""Muscles: activations to one displacement per skin vertex.

Every muscle has a calibrated field of displacement (facts: face-model, section 1). The equilibrium of a
linear network of springs is the sum of such fields. Flesh is not linear, so near-parallel pulls on one vertex
are limited here (facts: face-model, section 3): two muscles with the same effect do not have it twice.

Two muscles can also move together what neither moves alone, by joint fields, and muscles that push one lip
from two sides contract less than they are activated (`activations`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ...core.arrays import Array, ByteArray, IndexArray, IntArray, UInt32Array, UInt64Array
from ...core.parameters import INDEX, PARAMETERS
from ...errors import HeadError
from ...machine.kernels.jit import device, kernel
from ..head.head import Field, Head
from ..numerics.fours import (
    LANES,
    Four,
    added,
    added_times,
    four,
    inverse_cube_root,
    product,
    put,
    put_vector,
    roots,
    row,
    set_row,
    squares,
)
from .activations import YIELDS, Yields, activate, yields_of

# These have no field on the skin at rest: the jaw is a frame, and the lids slide over the eyeball.
ELSEWHERE = ("masseter", "orbicularis_oculi_palpebralis")

# Muscles that are heads of one sheet, or that lift one pad of flesh (the cheek): their fields are parts of
# one shape and add up to it, unlimited.
SHEETS = {
    "zygomatic_minor": "levator_labii_superioris",
    "corrugator_supercilii": "depressor_supercilii",
    "frontalis_lateralis": "frontalis_medialis",
    "orbicularis_oculi_orbitalis": "zygomatic_major",
}


@dataclass(frozen=True, slots=True)
class MuscleFields:
    """The fields of all muscles, sorted by vertex and then by source.

    Entries `start[v]:start[v + 1]` belong to vertex v: `parameter` (k,) index into the values, `source` (k,)
    the shape that they are parts of (both sides of a muscle, and the heads of a sheet, form one shape; a
    joint field is part of that of its first muscle), `muscle` (k,) the muscle that they are a side of,
    `displacement` (k, 3) in mm at activation 1. `acting` (n,) has the bits of the parameters that act on each
    vertex. `pairs` (j, 2) are the parameters of the joint fields, which are numbered after all parameters.
    `yields` are those of `activations.YIELDS`.
    """

    start: UInt32Array
    parameter: ByteArray
    source: ByteArray
    muscle: ByteArray
    displacement: Array
    acting: UInt64Array
    pairs: UInt32Array
    yields: Yields

    @classmethod
    def of(cls, head: Head) -> MuscleFields:
        """Gather the fields of `head`."""
        rows = fields_of(head)
        fields = [row.field for row in rows]
        sizes = [len(field.vertices) for field in fields]
        vertex = np.concatenate([field.vertices for field in fields])
        parameter, source, muscle = (np.repeat([row[k] for row in rows], sizes) for k in range(3))
        order = np.lexsort((parameter, muscle, source, vertex))
        start = np.searchsorted(vertex[order], np.arange(len(head.rest) + 1))
        bits = np.zeros(len(head.rest), np.uint64)
        np.bitwise_or.at(bits, vertex, np.left_shift(np.uint64(1), parameter.astype(np.uint64)))
        return cls(
            start.astype(np.uint32),
            parameter[order].astype(np.uint8),
            source[order].astype(np.uint8),
            muscle[order].astype(np.uint8),
            np.concatenate([field.displacement for field in fields])[order],
            bits,
            np.array([[INDEX[name] for name in pair] for pair in head.joint], np.uint32).reshape(-1, 2),
            yields_of(YIELDS),
        )

    @property
    def columns(self) -> int:
        """The number of activations: those of the parameters, and of the joint fields."""
        return len(PARAMETERS) + len(self.pairs)

    def activations(self, values: Array) -> Array:
        """Return the activations (46 + j,) for `values` (46,): the values, and those of the joint fields."""
        out = np.empty((1, self.columns))
        activate(self.pairs, *self.yields, values[None], out)
        return np.asarray(out[0])

    def at(self, vertices: IntArray) -> MuscleFields:
        """Return only the fields at some `vertices` (n,), in their order."""
        start = self.start.astype(np.int64)
        sizes = np.diff(start)[vertices]
        ends = np.concatenate([[0], np.cumsum(sizes)])
        entries = np.arange(ends[-1]) + np.repeat(start[vertices] - ends[:-1], sizes)
        return MuscleFields(
            ends.astype(np.uint32),
            self.parameter[entries],
            self.source[entries],
            self.muscle[entries],
            self.displacement[entries],
            self.acting[vertices],
            self.pairs,
            self.yields,
        )

    def displace(self, values: Array, out: Array) -> None:
        """Write the displacement (n, 3) in mm for `values` (46,) to `out`."""
        out[:] = DisplacedSkin(self).at(values)


AT_ONCE = LANES
"""Instants whose displacements are computed at once."""


class DisplacedSkin:
    """The skin displaced by the muscles; a new call recomputes only the vertices whose muscles changed."""

    def __init__(self, fields: MuscleFields) -> None:
        self._fields, self._rows = fields, np.zeros((AT_ONCE, fields.columns))
        self._before = np.zeros(fields.columns)
        self._skin = np.zeros((len(fields.acting), 3, AT_ONCE))
        self._work = np.zeros((fields.columns, AT_ONCE)), np.zeros((MOST * _PULL, AT_ONCE))
        self._entries = np.zeros(MOST, np.uint32)

    def at(self, values: Array) -> Array:
        """Return the displacement (n, 3) in mm for `values` (46,), as `over`."""
        return self.over(values[None])[:, :, -1]

    def over(self, values: Array) -> Array:
        """Return the displacements (n, 3, AT_ONCE) in mm for at most AT_ONCE rows of `values` (k, 46).

        The last row counts for those that are left over. The caller must not change the result, and the next
        call overwrites it.
        """
        fields = self._fields
        activate(fields.pairs, *fields.yields, values, self._rows)
        _displace(
            fields.start,
            fields.parameter,
            fields.source,
            fields.muscle,
            fields.displacement,
            fields.acting,
            self._rows,
            self._before,
            *self._work,
            self._entries,
            self._skin,
        )
        return self._skin


@kernel("i8[:], f8[:, 3, 4], i8, f8[:, :]")
def put_at(vertices: IndexArray, displaced: Array, number: int, out: Array) -> None:
    """Write one `number` of the displacements `displaced` (n, 3, AT_ONCE) to the `vertices` of `out`."""
    for k in range(len(vertices)):
        for c in range(3):
            out[vertices[k], c] = displaced[k, c, number]


MOST = 32  # no vertex has more entries
# mm that two muscles together may move a vertex beyond the larger alone; the second without any damping.
EXCESS, FREE_EXCESS = 1.45, 1.15
_PULL = 5  # rows of a pull: its three components, its length, and scratch
NOTHING = 1e-9  # mm: a smaller pull counts as none, because its cube would underflow
_MOST_COLUMNS = 64  # bits of `acting`


class FieldRow(NamedTuple):
    """A field of one column of the activations; `source` and `muscle` as in `MuscleFields`."""

    column: int
    source: int
    muscle: int
    field: Field


def fields_of(head: Head) -> list[FieldRow]:
    """Return the fields of muscles, then the joint ones; raise HeadError for more than there are bits."""
    acting = [p for p in PARAMETERS if p.name in head.fields and p.base not in ELSEWHERE]
    bases = list(dict.fromkeys(p.base for p in acting))

    def source(base: str) -> int:
        return bases.index(SHEETS.get(base, base))

    rows = [FieldRow(INDEX[p.name], source(p.base), bases.index(p.base), head.fields[p.name]) for p in acting]
    together = list(dict.fromkeys(tuple(_base(name) for name in pair) for pair in head.joint))
    for column, (pair, field) in enumerate(head.joint.items(), len(PARAMETERS)):
        muscle = len(bases) + together.index(tuple(_base(name) for name in pair))
        rows.append(FieldRow(column, source(_base(pair[0])), muscle, field))
    if len(PARAMETERS) + len(head.joint) > _MOST_COLUMNS:
        raise HeadError(
            f"head '{head.name}' has {len(head.joint)} joint fields; "
            f"expected at most {_MOST_COLUMNS - len(PARAMETERS)}"
        )
    return rows


def _base(name: str) -> str:
    return name.partition(".")[0]


@kernel(
    "u4[:], u1[:], u1[:], u1[:], f8[:, 3], u8[:], f8[:, :], f8[:], f8[:, 4], f8[:, 4], u4[:], f8[:, 3, 4]",
    arithmetic="fast",
)
def _displace(
    start: UInt32Array,
    parameter: ByteArray,
    source: ByteArray,
    muscle: ByteArray,
    displacement: Array,
    acting: UInt64Array,
    rows: Array,
    before: Array,
    lanes: Array,
    pulls: Array,
    entries: UInt32Array,
    out: Array,
) -> None:
    """Write the displacements at the activations in each of the `rows` to `out`; see `DisplacedSkin`.

    The vertices whose muscles differ in no row from `before`, which becomes the last row, keep the last one.
    `lanes` (46 + j, AT_ONCE), `pulls` (MOST · _PULL, AT_ONCE) and `entries` (MOST,) are scratch.
    """
    live, changed = _turn_rows(rows, before, lanes)
    for v in range(len(acting)):
        if not acting[v] & changed:
            for c in range(3):
                put(out, v, c, four(out[v, c, AT_ONCE - 1]))
            continue
        count = 0
        for e in range(start[v], start[v + 1]):
            entries[count] = e
            count += int((live >> np.uint64(parameter[e])) & np.uint64(1))
        if not acting[v] & live or count == 0:
            for c in range(3):
                put(out, v, c, four(0.0))
            continue
        sources = _gather(entries, count, parameter, source, displacement, lanes, pulls)
        if sources > 1:
            square = _limited_sum(pulls, sources, v, out)
        else:
            square = put_vector(out, v, row(pulls, 0), row(pulls, 1), row(pulls, 2))
        if max(square[0], square[1], square[2], square[3]) > FREE_EXCESS * FREE_EXCESS:
            for lane in range(AT_ONCE):
                _cap(entries, count, parameter, muscle, displacement, rows, lane, v, out)


@device("fast")
def _turn_rows(rows: Array, before: Array, lanes: Array) -> tuple[np.uint64, np.uint64]:
    """Copy activations in `rows` (AT_ONCE, 46 + j) to `lanes` (46 + j, AT_ONCE), the last row to `before`.

    Returns the bits of the parameters that are above 0 in a row, and of those that differ from `before`.
    """
    live, changed, one = np.uint64(0), np.uint64(0), np.uint64(1)
    for p in range(len(before)):
        bit = one << np.uint64(p)
        for lane in range(AT_ONCE):
            lanes[p, lane] = rows[lane, p]
            if rows[lane, p] > 0.0:
                live |= bit
            if rows[lane, p] != before[p]:
                changed |= bit
        before[p] = rows[AT_ONCE - 1, p]
    return live, changed


@device("fast", inlined=True)
def _gather(
    entries: UInt32Array,
    count: int,
    parameter: ByteArray,
    source: ByteArray,
    displacement: Array,
    lanes: Array,
    pulls: Array,
) -> int:
    """Write the pull of each source in the first `count` of `entries` to `pulls`; return their number."""
    s, last = -_PULL, -1
    x, y, z = four(0.0), four(0.0), four(0.0)
    for k in range(count):
        e = entries[k]
        if source[e] != last:
            last, s = int(source[e]), s + _PULL
            x, y, z = four(0.0), four(0.0), four(0.0)
        activation = row(lanes, parameter[e])
        x = added_times(x, activation, displacement[e, 0])
        y = added_times(y, activation, displacement[e, 1])
        z = added_times(z, activation, displacement[e, 2])
        set_row(pulls, s, x)
        set_row(pulls, s + 1, y)
        set_row(pulls, s + 2, z)
    return s // _PULL + 1


@device("fast", inlined=True)
def _cap(
    entries: UInt32Array,
    count: int,
    parameter: ByteArray,
    muscle: ByteArray,
    displacement: Array,
    rows: Array,
    lane: int,
    v: int,
    out: Array,
) -> None:
    """Shorten `out[v, :, lane]` if it is much longer than any of the muscles would make it alone.

    The muscles are those of the first `count` of `entries`. Of n equal ones, each of the last n − 1 may add
    up to EXCESS mm.
    """
    total, largest, own = 0.0, 0.0, 0.0
    x, y, z = 0.0, 0.0, 0.0
    for k in range(count):
        e = entries[k]
        if k > 0 and muscle[e] != muscle[entries[k - 1]]:
            total, largest = total + own, max(largest, own)
            x, y, z = 0.0, 0.0, 0.0
        activation = rows[lane, parameter[e]]
        x += activation * displacement[e, 0]
        y += activation * displacement[e, 1]
        z += activation * displacement[e, 2]
        own = np.sqrt(x * x + y * y + z * z)
    x, y, z = out[v, 0, lane], out[v, 1, lane], out[v, 2, lane]
    length = np.sqrt(x * x + y * y + z * z)
    total, largest = total + own, max(largest, own)
    if length <= largest + FREE_EXCESS:
        return
    others = max(total / largest - 1.0, 1.0)
    over = length - largest - others * FREE_EXCESS
    if over > 0.0:
        room = others * (EXCESS - FREE_EXCESS)
        allowed = length - over + room * np.tanh(over / room)
        for c in range(3):
            out[v, c, lane] *= allowed / length


@device("fast", inlined=True)
def _limited_sum(pulls: Array, count: int, v: int, out: Array) -> Four:
    """Write to `out[v]` the limited sum of the first `count` of `pulls`; return the square of its length.

    Each pull D counts |D|² / (Σ |D'|³ c²)^⅔ times, over all D', with c the cosine between D and D' if it is
    positive, else 0. A single pull, and pulls at right angles or against each other, are exact; n equal
    parallel pulls give ∛n times one. The sum is continuous and does not depend on the frame of reference.
    The last rows of a pull are its length, and Σ |D'| (D·D')² over the others.
    """
    for m in range(0, _PULL * count, _PULL):
        mx, my, mz = row(pulls, m), row(pulls, m + 1), row(pulls, m + 2)
        own, parallel = roots(squares(mx, my, mz)), four(0.0)
        for n in range(0, m, _PULL):
            dot = product(mx, row(pulls, n))
            dot = added(added(dot, my, row(pulls, n + 1)), mz, row(pulls, n + 2))
            along = max(dot[0], 0.0), max(dot[1], 0.0), max(dot[2], 0.0), max(dot[3], 0.0)
            square = product(along, along)
            parallel = added(parallel, square, row(pulls, n + 3))
            set_row(pulls, n + 4, added(row(pulls, n + 4), square, own))
        set_row(pulls, m + 3, own)
        set_row(pulls, m + 4, parallel)
    x, y, z = four(0.0), four(0.0), four(0.0)
    for m in range(0, _PULL * count, _PULL):
        own, parallel = row(pulls, m + 3), row(pulls, m + 4)
        share = (
            _share(own[0], parallel[0]),
            _share(own[1], parallel[1]),
            _share(own[2], parallel[2]),
            _share(own[3], parallel[3]),
        )
        x = added(x, share, row(pulls, m))
        y = added(y, share, row(pulls, m + 1))
        z = added(z, share, row(pulls, m + 2))
    return put_vector(out, v, x, y, z)


@device("fast")
def _share(own: float, parallel: float) -> float:
    """Return how much a pull counts beside others, see `_limited_sum`."""
    whole = max(own, NOTHING)
    less = inverse_cube_root(parallel / (whole * whole * whole * whole * whole) + 1.0)
    return less * less if own > NOTHING and parallel > 0.0 else 1.0
