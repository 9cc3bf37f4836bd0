"""What muscles do together: overshoot and flipped faces over all pairs and many random combinations.

Run from the repository's root: `.venv/bin/python benchmarks/face_sweep.py [--random 10000]`.
Targets (issue: the face): two muscles together (the jaw apart) at most 2.5 mm beyond the larger, no flipped
face on the visible skin, mouth's corners and lids included, for any pair at full contraction or any random
combination free of conflicts. Both sides of a muscle contract together in pairs; a random combination takes
each muscle by itself. Left out is what lines mouth and eye sockets.
"""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from risorius.core.parameters import INDEX, MUSCLES, NEUTRAL, RIVALS
from risorius.face.head import Head, load_head
from risorius.face.solve import FaceSolver

Array = npt.NDArray[np.float64]
Mask = npt.NDArray[np.bool_]

BASES = tuple(dict.fromkeys(m.base for m in MUSCLES))
JAW = "masseter"
MOUTH_LINING = 0.2  # of the inner mouth's mask, above which skin is not seen
SOCKET = 4.0  # mm about the eyeball: the lids' margins do turn over, the lining behind them is not seen
SMALLEST = 0.05  # mm² of the smallest face that counts: about one pixel of a close-up 1080 pixels high


def visible(head: Head) -> Mask:
    """Return which level-1 vertices (N1,) are seen: not the inner mouth, nor what lines the eyes' sockets."""
    rest = head.skin.matrix @ head.rest
    seen = np.asarray(head.skin.matrix @ head.masks["inner_mouth"] < MOUTH_LINING)
    for centre, radius in zip(head.eye_centre, head.eye_radius, strict=True):
        seen &= np.linalg.norm(rest - centre, axis=1) > radius + SOCKET
    return seen


def normals(skin: Array, quads: npt.NDArray[np.int32]) -> Array:
    """Return the normals (q, 3) of faces, as long as twice their areas."""
    a, b, c, d = (skin[quads[:, k]].astype(np.float64) for k in range(4))
    return np.asarray(np.cross(c - a, d - b))


class Flips:
    """Counts faces that are folded over: they look the other way than the faces about them, and than they
    would had they only turned with the skin about them. The second tells a fold from a crease of the rest.
    """

    def __init__(self, head: Head) -> None:
        self.quads = head.skin.quads
        self.seen = visible(head)[self.quads].all(axis=1)
        self._rest = head.skin.matrix @ head.rest
        self._normals = normals(self._rest, self.quads)
        rows = np.repeat(np.arange(len(self.quads)), 4)
        corners = sp.csr_matrix((np.ones(len(rows)), (rows, self.quads.ravel())))
        self._around = ((corners @ corners.T) > 0).astype(np.float64)

    def count(self, skin: Array) -> int:
        """Return how many visible faces of `skin` (N1, 3) are flipped."""
        return len(self.find(skin))

    def find(self, skin: Array) -> npt.NDArray[np.intp]:
        """Return the visible faces of `skin` (N1, 3) that are flipped."""
        own = normals(skin, self.quads)
        against = ((own * (self._around @ own)).sum(axis=1) < 0.0) & self.seen
        against &= np.linalg.norm(own, axis=1) > 2.0 * SMALLEST
        return np.array(
            [q for q in np.flatnonzero(against) if self._carried(skin, q) @ own[q] < 0.0], np.intp
        )

    def _carried(self, skin: Array, quad: int) -> Array:
        """Return the normal (3,) of a face at rest, turned as the skin about it has turned (Kabsch)."""
        about = np.unique(self.quads[(self._around[quad] @ self._around).indices])
        before, now = (p[about].astype(np.float64) - p[about].mean(axis=0) for p in (self._rest, skin))
        u, _, vt = np.linalg.svd(before.T @ now)
        u[:, 2] *= np.linalg.det(u @ vt)
        return np.asarray(self._normals[quad] @ u @ vt)


def contracted(bases: Sequence[str]) -> Array:
    """Return the values (46,) with both sides of some muscles at 1."""
    values = np.array(NEUTRAL)
    for m in MUSCLES:
        if m.base in bases:
            values[INDEX[m.name]] = 1.0
    return values


def random_values(draw: np.random.Generator) -> Array:
    """Return values (46,) of a random combination free of conflicts: any number of muscles, 0 to 1."""
    values = np.array(NEUTRAL)
    chosen: set[str] = set()
    for i in draw.permutation(len(MUSCLES))[: draw.integers(2, len(MUSCLES) + 1)]:
        name = MUSCLES[i].name
        if not chosen & set(RIVALS[name]):
            chosen.add(name)
            values[INDEX[name]] = draw.random()
    return values


def pairs(head: Head, solver: FaceSolver, flips: Flips) -> None:
    """Print the largest overshoots, and the pairs with flipped faces."""
    seen = visible(head)
    rest = head.skin.matrix @ head.rest
    alone = {b: np.linalg.norm(solver.solve(contracted([b])).skin - rest, axis=1) for b in BASES}
    found, flipped = [], []
    for a, b in itertools.combinations(BASES, 2):
        values = contracted([a, b])
        skin = solver.solve(values).skin
        if count := flips.count(skin):
            flipped.append((count, a, b))
        if JAW not in (a, b):
            over = np.linalg.norm(skin - rest, axis=1) - np.maximum(alone[a], alone[b])
            found.append((float(over[seen].max()), a, b))
    for over, a, b in sorted(found, reverse=True)[:5]:
        print(f"overshoot {over:5.2f} mm: {a} with {b}")
    print(f"pairs with flipped faces: {len(flipped)} of {len(found) + len(BASES) - 1}")
    for count, a, b in sorted(flipped, reverse=True)[:10]:
        print(f"  {count} faces: {a} with {b}")


def combinations(solver: FaceSolver, flips: Flips, number: int) -> None:
    """Print how many random combinations flip a face."""
    draw = np.random.default_rng(0)
    bad, worst = 0, 0
    for _ in range(number):
        values = random_values(draw)
        count = flips.count(solver.solve(values).skin)
        bad, worst = bad + (count > 0), max(worst, count)
    print(f"random combinations with flipped faces: {bad} of {number}")
    print(f"  at most {worst} of {flips.seen.sum()} visible faces")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--random", type=int, default=10_000)
    parser.add_argument("--head", default="standard")
    arguments = parser.parse_args()
    head = load_head(arguments.head)
    solver = FaceSolver(head)
    flips = Flips(head)
    pairs(head, solver, flips)
    combinations(solver, flips, arguments.random)


if __name__ == "__main__":
    main()
