"""Muscles: activations to one displacement per skin vertex.

Every muscle has a calibrated field of displacement (facts: face-model, section 1). The equilibrium of a
linear network of springs is the sum of such fields. Flesh is not linear, so near-parallel pulls on one vertex
are limited here (facts: face-model, section 3): two muscles with the same effect do not have it twice.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..core.arrays import Array, ByteArray, IndexArray, IntArray, UInt32Array, UInt64Array
from ..core.kernels.jit import inlined, kernel, summing_kernel
from ..core.parameters import INDEX, PARAMETERS
from .head import Head
from .roots import inverse_cube_root

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
    the shape that they are parts of (both sides of a muscle, and the heads of a sheet, form one shape),
    `muscle` (k,) the muscle that they are a side of, `displacement` (k, 3) in mm at activation 1. `acting`
    (n,) has the bits of the parameters that act on each vertex.
    """

    start: UInt32Array
    parameter: ByteArray
    source: ByteArray
    muscle: ByteArray
    displacement: Array
    acting: UInt64Array

    @classmethod
    def of(cls, head: Head) -> MuscleFields:
        """Gather the fields of `head`."""
        acting = [p for p in PARAMETERS if p.name in head.fields and p.base not in ELSEWHERE]
        bases = list(dict.fromkeys(p.base for p in acting))
        sheets = [bases.index(SHEETS.get(p.base, p.base)) for p in acting]
        muscles = [bases.index(p.base) for p in acting]
        fields = [head.fields[p.name] for p in acting]
        sizes = [len(field.vertices) for field in fields]
        vertex = np.concatenate([field.vertices for field in fields])
        parameter = np.repeat([INDEX[p.name] for p in acting], sizes)
        source, muscle = np.repeat(sheets, sizes), np.repeat(muscles, sizes)
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
        )

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
        )

    def without(self, vertices: IndexArray) -> MuscleFields:
        """Return the same, with nothing at some `vertices` (n,)."""
        acting = self.acting.copy()
        acting[vertices] = 0
        return replace(self, acting=acting)

    def displace(self, values: Array, out: Array) -> None:
        """Write the displacement (n, 3) in mm for `values` (46,) to `out`."""
        out[:] = 0.0
        _displace(*self._arrays(), values, _bits(values), _EVERY, out)

    def update(self, before: Array, values: Array, out: Array) -> None:
        """Change `out` (n, 3), the displacement for the values `before` (46,), to that for `values` (46,).

        Vertices whose muscles have not changed are skipped; `before` becomes `values`.
        """
        changed = _bits_of_changes(before, values)
        if changed:
            _displace(*self._arrays(), values, _bits(values), changed, out)

    def _arrays(self) -> tuple[UInt32Array, ByteArray, ByteArray, ByteArray, Array, UInt64Array]:
        return self.start, self.parameter, self.source, self.muscle, self.displacement, self.acting


class DisplacedSkin:
    """The skin displaced by the muscles; a new call recomputes only the vertices whose muscles changed."""

    def __init__(self, fields: MuscleFields) -> None:
        self._fields, self._values = fields, np.zeros(len(PARAMETERS))
        self._skin = np.zeros((len(fields.acting), 3))

    def at(self, values: Array) -> Array:
        """Return the displacement (n, 3) in mm for `values` (46,).

        The caller must not change it, and the next call overwrites it.
        """
        self._fields.update(self._values, values, self._skin)
        return self._skin


MOST = 32  # no vertex has more entries
# mm that two muscles together may move a vertex beyond the larger alone; the second without any damping.
EXCESS, FREE_EXCESS = 1.45, 1.15
_PULL = 8  # columns of a pull, one cache line: its three components, and scratch
NOTHING = 1e-9  # mm: a smaller pull counts as none, because its cube would underflow
_EVERY = np.uint64(2**64 - 1)


@kernel
def _bits(values: Array) -> np.uint64:
    """Return the bits of the parameters that are above 0."""
    bits, one = np.uint64(0), np.uint64(1)
    for p in range(len(values)):
        if values[p] > 0.0:
            bits |= one << np.uint64(p)
    return bits


@kernel
def _bits_of_changes(before: Array, values: Array) -> np.uint64:
    """Return the bits of the parameters that differ, and copy `values` to `before`."""
    bits, one = np.uint64(0), np.uint64(1)
    for p in range(len(values)):
        if values[p] != before[p]:
            bits |= one << np.uint64(p)
            before[p] = values[p]
    return bits


@summing_kernel
def _displace(
    start: UInt32Array,
    parameter: ByteArray,
    source: ByteArray,
    muscle: ByteArray,
    displacement: Array,
    acting: UInt64Array,
    values: Array,
    live: np.uint64,
    changed: np.uint64,
    out: Array,
) -> None:
    entries, pulls = np.empty(MOST, np.uint32), np.empty((MOST, _PULL))
    for v in range(len(out)):
        if not acting[v] & changed:
            continue
        if not acting[v] & live:
            out[v, 0], out[v, 1], out[v, 2] = 0.0, 0.0, 0.0
            continue
        count = 0
        for e in range(start[v], start[v + 1]):
            entries[count] = e
            count += values[parameter[e]] > 0.0
        sources = _gather(entries, count, parameter, source, displacement, values, pulls)
        if sources > 1:
            _limited_sum(pulls, sources, v, out)
        else:
            out[v, 0], out[v, 1], out[v, 2] = pulls[0, 0], pulls[0, 1], pulls[0, 2]
        square = out[v, 0] * out[v, 0] + out[v, 1] * out[v, 1] + out[v, 2] * out[v, 2]
        if square > FREE_EXCESS * FREE_EXCESS:
            _cap(entries, count, parameter, muscle, displacement, values, np.sqrt(square), v, out)


@inlined
def _gather(
    entries: UInt32Array,
    count: int,
    parameter: ByteArray,
    source: ByteArray,
    displacement: Array,
    values: Array,
    pulls: Array,
) -> int:
    """Write the pull of each source in the first `count` of `entries` to `pulls`; return their number."""
    e = entries[0]
    last, s, activation = source[e], 0, values[parameter[e]]
    for c in range(3):
        pulls[0, c] = activation * displacement[e, c]
    for k in range(1, count):
        e = entries[k]
        activation = values[parameter[e]]
        if source[e] != last:
            last, s = source[e], s + 1
            for c in range(3):
                pulls[s, c] = activation * displacement[e, c]
        else:
            for c in range(3):
                pulls[s, c] += activation * displacement[e, c]
    return s + 1


@inlined
def _cap(
    entries: UInt32Array,
    count: int,
    parameter: ByteArray,
    muscle: ByteArray,
    displacement: Array,
    values: Array,
    length: float,
    v: int,
    out: Array,
) -> None:
    """Shorten `out[v]`, `length` mm long, if it is much longer than any of the muscles would make it alone.

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
        activation = values[parameter[e]]
        x += activation * displacement[e, 0]
        y += activation * displacement[e, 1]
        z += activation * displacement[e, 2]
        own = np.sqrt(x * x + y * y + z * z)
    if total == 0.0 or length <= max(largest, own) + FREE_EXCESS:
        return
    total, largest = total + own, max(largest, own)
    others = max(total / largest - 1.0, 1.0)
    over = length - largest - others * FREE_EXCESS
    if over > 0.0:
        room = others * (EXCESS - FREE_EXCESS)
        allowed = length - over + room * np.tanh(over / room)
        for c in range(3):
            out[v, c] *= allowed / length


@inlined
def _limited_sum(pulls: Array, count: int, v: int, out: Array) -> None:
    """Write to `out[v]` the limited sum of the first `count` of `pulls`.

    Each pull D counts |D|² / (Σ |D'|³ c²)^⅔ times, over all D', with c the cosine between D and D' if it is
    positive, else 0. A single pull, and pulls at right angles or against each other, are exact; n equal
    parallel pulls give ∛n times one. The sum is continuous and does not depend on the frame of reference.
    Columns 3 and 4 of `pulls` are scratch: lengths, and Σ |D'| (D·D')² over the others.
    """
    for m in range(count):
        square = pulls[m, 0] * pulls[m, 0] + pulls[m, 1] * pulls[m, 1] + pulls[m, 2] * pulls[m, 2]
        pulls[m, 3], pulls[m, 4] = np.sqrt(square), 0.0
    for m in range(1, count):
        for n in range(m):
            dot = pulls[m, 0] * pulls[n, 0] + pulls[m, 1] * pulls[n, 1] + pulls[m, 2] * pulls[n, 2]
            along = max(dot, 0.0)
            pulls[m, 4] += along * along * pulls[n, 3]
            pulls[n, 4] += along * along * pulls[m, 3]
    x, y, z = 0.0, 0.0, 0.0
    for m in range(count):
        own, share = pulls[m, 3], 1.0
        if own > NOTHING and pulls[m, 4] > 0.0:
            share = inverse_cube_root(1.0 + pulls[m, 4] / (own * own * own * own * own)) ** 2
        x, y, z = x + share * pulls[m, 0], y + share * pulls[m, 1], z + share * pulls[m, 2]
    out[v, 0], out[v, 1], out[v, 2] = x, y, z
