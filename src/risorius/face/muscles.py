"""Muscles: activations to one displacement per skin vertex.

Every muscle has a calibrated field of displacement (facts: face-model, section 1). At equilibrium a linear
network of springs is the plain sum of such fields; flesh is not linear, so near-parallel pulls on one vertex
are limited here (facts: face-model, section 3), which keeps two muscles that do the same thing from doing it
twice.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from ..core.parameters import INDEX, PARAMETERS
from .head import Head
from .jit import compiled, compiled_fast, inlined
from .roots import inverse_cube_root

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.uint32]
Bits = npt.NDArray[np.uint64]

# These do not act by a field on the skin at rest: the jaw is a frame, the lids slide over the eyeball.
ELSEWHERE = ("masseter", "orbicularis_oculi_palpebralis")

# Muscles that are heads of one sheet: their fields are parts of one shape and add up to it, unlimited.
SHEETS = {
    "zygomatic_minor": "levator_labii_superioris",
    "corrugator_supercilii": "depressor_supercilii",
}


@dataclass(frozen=True, slots=True)
class MuscleFields:
    """The fields of all muscles, sorted by vertex and then by source.

    Entries `start[v]:start[v + 1]` belong to vertex v: `parameter` (k,) index into the values, `source` (k,)
    what they are a part of (the two sides of a muscle, and the heads of a sheet, meet as parts of one shape),
    `muscle` (k,) which muscle they are a side of, `displacement` (k, 3) in mm at activation 1. `acting` (n,)
    has the bits of the parameters that act on each vertex.
    """

    start: IntArray
    parameter: IntArray
    source: IntArray
    muscle: IntArray
    displacement: Array
    acting: Bits

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
            parameter[order].astype(np.uint32),
            source[order].astype(np.uint32),
            muscle[order].astype(np.uint32),
            np.concatenate([field.displacement for field in fields])[order],
            bits,
        )

    def at(self, vertices: npt.NDArray[np.intp]) -> MuscleFields:
        """Return the fields at some `vertices` (n,) only, in their order."""
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

    def without(self, vertices: npt.NDArray[np.intp]) -> MuscleFields:
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

        Vertices whose muscles have not changed are left alone; `before` becomes `values`.
        """
        changed = _bits_of_changes(before, values)
        if changed:
            _displace(*self._arrays(), values, _bits(values), changed, out)

    def _arrays(self) -> tuple[IntArray, IntArray, IntArray, IntArray, Array, Bits]:
        return self.start, self.parameter, self.source, self.muscle, self.displacement, self.acting


class Displaced:
    """The skin as the muscles displace it, kept from one call to the next: what has not changed stays."""

    def __init__(self, fields: MuscleFields) -> None:
        self._fields, self._values = fields, np.zeros(len(PARAMETERS))
        self._skin = np.zeros((len(fields.acting), 3))

    def at(self, values: Array) -> Array:
        """Return the displacement (n, 3) in mm for `values` (46,), not to be changed.

        It holds until this is called again.
        """
        self._fields.update(self._values, values, self._skin)
        return self._skin


MOST = 32  # entries of one vertex, at least
# mm by which two muscles together may move a vertex further than the larger alone, and up to which freely.
EXCESS, FREE_EXCESS = 1.75, 1.3
NOTHING = 1e-9  # mm: a pull this small is as long as none, and its cube would be too small a number
_EVERY = np.uint64(2**64 - 1)


@compiled
def _bits(values: Array) -> np.uint64:
    """Return the bits of the parameters that are above 0."""
    bits, one = np.uint64(0), np.uint64(1)
    for p in range(len(values)):
        if values[p] > 0.0:
            bits |= one << np.uint64(p)
    return bits


@compiled
def _bits_of_changes(before: Array, values: Array) -> np.uint64:
    """Return the bits of the parameters that differ, and copy `values` to `before`."""
    bits, one = np.uint64(0), np.uint64(1)
    for p in range(len(values)):
        if values[p] != before[p]:
            bits |= one << np.uint64(p)
            before[p] = values[p]
    return bits


@compiled_fast
def _displace(
    start: IntArray,
    parameter: IntArray,
    source: IntArray,
    muscle: IntArray,
    displacement: Array,
    acting: Bits,
    values: Array,
    live: np.uint64,
    changed: np.uint64,
    out: Array,
) -> None:
    entries, pulls, lengths = np.empty(MOST, np.uint32), np.empty((MOST, 3)), np.empty(MOST)
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
        if count == 1:
            e = entries[0]
            activation = values[parameter[e]]
            for c in range(3):
                out[v, c] = activation * displacement[e, c]
        else:
            _join(entries, count, parameter, source, muscle, displacement, values, pulls, lengths, v, out)


@inlined
def _join(
    entries: IntArray,
    count: int,
    parameter: IntArray,
    source: IntArray,
    muscle: IntArray,
    displacement: Array,
    values: Array,
    pulls: Array,
    lengths: Array,
    v: int,
    out: Array,
) -> None:
    """Write to `out[v]` what the first `count` of `entries` do together; `pulls`, `lengths` are scratch."""
    sources, muscles, last, last_muscle = 0, 0, source[entries[0]] + 1, muscle[entries[0]] + 1
    total, largest = 0.0, 0.0
    x, y, z = 0.0, 0.0, 0.0
    for k in range(count):
        e = entries[k]
        if source[e] != last:
            last, sources = source[e], sources + 1
            for c in range(3):
                pulls[sources - 1, c] = 0.0
        if muscle[e] != last_muscle:
            length = np.sqrt(x * x + y * y + z * z)
            total, largest = total + length, max(largest, length)
            last_muscle, muscles = muscle[e], muscles + 1
            x, y, z = 0.0, 0.0, 0.0
        activation = values[parameter[e]]
        dx, dy, dz = (
            activation * displacement[e, 0],
            activation * displacement[e, 1],
            activation * displacement[e, 2],
        )
        x, y, z = x + dx, y + dy, z + dz
        pulls[sources - 1, 0] += dx
        pulls[sources - 1, 1] += dy
        pulls[sources - 1, 2] += dz
    _limited_sum(pulls, lengths, sources, v, out)
    if muscles > 1:
        length = np.sqrt(x * x + y * y + z * z)
        _cap(v, out, total + length, max(largest, length))


@inlined
def _cap(v: int, out: Array, total: float, largest: float) -> None:
    """Shorten `out[v]` where it is much longer than the `largest` of the muscles' displacements.

    `total` is the sum of their lengths: of n equal ones the last n − 1 may each add up to EXCESS mm.
    """
    length = np.sqrt(out[v, 0] * out[v, 0] + out[v, 1] * out[v, 1] + out[v, 2] * out[v, 2])
    if length <= largest + FREE_EXCESS:
        return
    others = max(total / largest - 1.0, 1.0) if largest > 0.0 else 1.0
    over = length - largest - others * FREE_EXCESS
    if over > 0.0:
        room = others * (EXCESS - FREE_EXCESS)
        allowed = length - over + room * np.tanh(over / room)
        for c in range(3):
            out[v, c] *= allowed / length


@inlined
def _limited_sum(pulls: Array, lengths: Array, count: int, v: int, out: Array) -> None:
    """Write to `out[v]` the sum of the first `count` pulls D, each times |D|² / (Σ |D'|³ c²)^⅔ over all D',
    c the cosine between D and D' where that is positive.

    A pull alone, and pulls at right angles or against each other, are exact; n equal parallel pulls give
    ∛n times one. Continuous, and the same in every frame of reference. `lengths` is scratch.
    """
    x, y, z = 0.0, 0.0, 0.0
    for m in range(count):
        lengths[m] = np.sqrt(_dot(pulls, m, m))
    for m in range(count):
        own, share = lengths[m], 1.0
        if own > NOTHING:
            shared = 0.0
            for n in range(count):
                if n != m:
                    along = max(_dot(pulls, m, n), 0.0) / own
                    shared += along * along * lengths[n]
            if shared > 0.0:
                share = inverse_cube_root(1.0 + shared / (own * own * own)) ** 2
        x, y, z = x + share * pulls[m, 0], y + share * pulls[m, 1], z + share * pulls[m, 2]
    out[v, 0], out[v, 1], out[v, 2] = x, y, z


@inlined
def _dot(pulls: Array, m: int, n: int) -> float:
    return float(pulls[m, 0] * pulls[n, 0] + pulls[m, 1] * pulls[n, 1] + pulls[m, 2] * pulls[n, 2])
