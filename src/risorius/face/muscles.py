"""Muscles: activations to one displacement per skin vertex.

Every muscle has a calibrated field of displacement (facts: face-model, section 1). At equilibrium a linear
network of springs is the plain sum of such fields; flesh is not linear, so near-parallel pulls on one vertex
are limited here (facts: face-model, section 3), which keeps two muscles that do the same thing from doing it
twice.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..core.parameters import INDEX, PARAMETERS
from .head import Head
from .jit import compiled

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]

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
    `muscle` (k,) which muscle they are a side of, `displacement` (k, 3) in mm at activation 1.
    """

    start: IntArray
    parameter: IntArray
    source: IntArray
    muscle: IntArray
    displacement: Array

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
        return cls(
            np.searchsorted(vertex[order], np.arange(len(head.rest) + 1)).astype(np.int32),
            parameter[order].astype(np.int32),
            source[order].astype(np.int32),
            muscle[order].astype(np.int32),
            np.concatenate([field.displacement for field in fields])[order],
        )

    def at(self, vertices: npt.NDArray[np.intp]) -> MuscleFields:
        """Return the fields at some `vertices` (n,) only, in their order."""
        sizes = np.diff(self.start)[vertices]
        ends = np.concatenate([[0], np.cumsum(sizes)])
        entries = np.arange(ends[-1]) + np.repeat(self.start[vertices] - ends[:-1], sizes)
        return MuscleFields(
            ends.astype(np.int32),
            self.parameter[entries],
            self.source[entries],
            self.muscle[entries],
            self.displacement[entries],
        )

    def displace(self, values: Array, out: Array) -> None:
        """Write the displacement (N0, 3) in mm for `values` (46,) to `out`."""
        _displace(self.start, self.parameter, self.source, self.muscle, self.displacement, values, out)


MOST_SOURCES = 32
# mm by which two muscles together may move a vertex further than the larger alone, and up to which freely.
EXCESS, FREE_EXCESS = 2.1, 1.4


@compiled
def _displace(
    start: IntArray,
    parameter: IntArray,
    source: IntArray,
    muscle: IntArray,
    displacement: Array,
    values: Array,
    out: Array,
) -> None:
    pulls, lengths, own = np.empty((MOST_SOURCES, 3)), np.empty(MOST_SOURCES), np.zeros(3)
    for v in range(len(out)):
        count, muscles, last, last_muscle = 0, 0, -1, -1
        total, largest = 0.0, 0.0
        own[:] = 0.0
        for e in range(start[v], start[v + 1]):
            activation = values[parameter[e]]
            if activation <= 0.0:
                continue
            if source[e] != last:
                last = source[e]
                pulls[count] = 0.0
                count += 1
            if muscle[e] != last_muscle:
                length = np.sqrt(_dot(own, own))
                total, largest = total + length, max(largest, length)
                last_muscle, muscles = muscle[e], muscles + 1
                own[:] = 0.0
            for c in range(3):
                pull = activation * displacement[e, c]
                pulls[count - 1, c] += pull
                own[c] += pull
        _limited_sum(pulls, lengths, count, out[v])
        if muscles > 1:
            length = np.sqrt(_dot(own, own))
            _cap(out[v], total + length, max(largest, length))


@compiled
def _cap(out: Array, total: float, largest: float) -> None:
    """Shorten `out` (3,) where it is much longer than the `largest` of the muscles' displacements.

    `total` is the sum of their lengths: of n equal ones the last n − 1 may each add up to EXCESS mm.
    """
    length = np.sqrt(_dot(out, out))
    others = max(total / largest - 1.0, 1.0) if largest > 0.0 else 1.0
    over = length - largest - others * FREE_EXCESS
    if over > 0.0:
        room = others * (EXCESS - FREE_EXCESS)
        allowed = length - over + room * np.tanh(over / room)
        for c in range(3):
            out[c] *= allowed / length


@compiled
def _limited_sum(pulls: Array, lengths: Array, count: int, out: Array) -> None:
    """Sum the first `count` pulls D, each times |D|² / (Σ |D'|³ max(0, cos(D, D'))²)^⅔ over all D'.

    A pull alone, and pulls at right angles or against each other, are exact; n equal parallel pulls give
    ∛n times one. Continuous, and the same in every frame of reference. `lengths` is scratch.
    """
    out[:] = 0.0
    for m in range(count):
        lengths[m] = np.sqrt(_dot(pulls[m], pulls[m]))
    for m in range(count):
        own = lengths[m] ** 2
        shared, alone = 0.0, True
        for n in range(count):
            along = _dot(pulls[m], pulls[n])
            if along > 0.0:
                shared += along**2 * lengths[n]
                alone = alone and n == m
        if shared > 0.0:
            share = 1.0 if alone else own / np.cbrt(shared / own) ** 2
            for c in range(3):
                out[c] += share * pulls[m, c]


@compiled
def _dot(a: Array, b: Array) -> float:
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
