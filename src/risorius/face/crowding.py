"""Skin that several muscles push together gives way before it folds over.

An edge of the mesh keeps a share of its length along its own direction, or what the hardest muscle alone
leaves of it: so muscles alone stay exact. The limits are linear in the displacement before the jaw turns it,
and are met by sweeps of equal pushes at both ends (position-based dynamics, Müller et al. 2007, one-sided
constraints), which is continuous in every activation.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..core.parameters import PARAMETERS
from .head import Head
from .jit import compiled
from .muscles import ELSEWHERE

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]

LEAST = 0.6  # of an edge's length at rest that is left to it along its direction
SWEEPS = 20
NEAR = 1e-6  # mm: edges at rest are longer


@dataclass(frozen=True, slots=True)
class Crowding:
    """What muscles could fold over: `edges` (e, 2), diagonals of faces among them, their unit directions
    `way` (e, 3), and the most in mm by which each may shorten, `room` (e,).
    """

    edges: IntArray
    way: Array
    room: Array

    @classmethod
    def of(cls, head: Head) -> Crowding:
        """Find the edges of `head` that all muscles together could shorten to less than is left to them."""
        edges = struts(head.quads)
        vector = head.rest[edges[:, 1]] - head.rest[edges[:, 0]]
        length = np.linalg.norm(vector, axis=1)
        way = vector / np.maximum(length, NEAR)[:, None]
        shortened = [_shortened(field, edges, way) for field in _fields(head)]
        hardest = np.max(shortened, axis=0)
        room = np.maximum((1.0 - LEAST) * length, hardest)
        risky = (np.sum(shortened, axis=0) > room) & (length > NEAR)
        return cls(edges[risky].astype(np.int32), way[risky], room[risky])

    def relieve(self, displacement: Array) -> None:
        """Change `displacement` (N0, 3) mm in place until no edge is shorter than it may be."""
        relieve(self.edges, self.way, self.room, SWEEPS, displacement)


def struts(quads: npt.NDArray[np.integer]) -> npt.NDArray[np.integer]:
    """Return the sides and diagonals (e, 2) of `quads` (Q, 4), each once."""
    ends = [quads[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3))]
    return np.asarray(np.unique(np.sort(np.vstack(ends), axis=1), axis=0))


def _fields(head: Head) -> list[Array]:
    """Return the displacement (N0, 3) of every muscle at 1, of both sides together."""
    found: dict[str, Array] = {}
    for p in PARAMETERS:
        if p.name in head.fields and p.base not in ELSEWHERE:
            whole = found.setdefault(p.base, np.zeros_like(head.rest))
            whole[head.fields[p.name].vertices] += head.fields[p.name].displacement
    return list(found.values())


def _shortened(field: Array, edges: npt.NDArray[np.integer], way: Array) -> Array:
    """Return by how many mm (e,) a field shortens edges along `way`; 0 where it does not."""
    return np.asarray(np.maximum(-((field[edges[:, 1]] - field[edges[:, 0]]) * way).sum(axis=1), 0.0))


@compiled
def relieve(edges: IntArray, way: Array, room: Array, sweeps: int, displacement: Array) -> None:
    """Push the ends of `edges` (e, 2) apart along `way` (e, 3) where they come nearer than by `room` (e,) mm.

    `displacement` (n, 3) mm is changed in place, in at most `sweeps` sweeps.
    """
    for _ in range(sweeps):
        moved = False
        for e in range(len(edges)):
            a, b = edges[e, 0], edges[e, 1]
            shortened = 0.0
            for c in range(3):
                shortened += (displacement[a, c] - displacement[b, c]) * way[e, c]
            excess = shortened - room[e]
            if excess > 0.0:
                moved = True
                for c in range(3):
                    displacement[a, c] -= 0.5 * excess * way[e, c]
                    displacement[b, c] += 0.5 * excess * way[e, c]
        if not moved:
            break
