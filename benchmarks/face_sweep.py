"""What muscles do together: overshoot and flipped faces over all pairs and many random combinations.

Run from the repository's root:
`python benchmarks/face_sweep.py [--random 10000] [--head NAME[@AGE]] [--lips]`.
Targets (issue: the face): two muscles together (the jaw apart) at most 2.5 mm beyond the larger, no flipped
face on the visible skin, mouth's corners and lids included, for any pair at full contraction or any random
combination free of conflicts. Both sides of a muscle contract together in pairs; a random combination takes
each muscle by itself. Left out are slivers (told apart), the inner mouth, and what lines the eyes' sockets
behind the front of the eyeballs. With `--lips` the overlap of the lips in the random combinations is measured
instead: at most 0.1 mm on the standard head, 0.3 on the others.
"""

from __future__ import annotations

import argparse
import itertools
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from tests.face.flips import SMALLEST, Flips, visible  # noqa: E402
from tests.face.poses import BASES, JAW, contracted, random_values  # noqa: E402
from tests.face.winding import LipTester  # noqa: E402

from risorius.face.head.head import Head, load_head  # noqa: E402
from risorius.face.solve import FaceSolver  # noqa: E402


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
    """Print how many random combinations flip a face, and how many but for a sliver none."""
    draw = np.random.default_rng(0)
    counts, slivers, worst = [], 0, 0.0
    for _ in range(number):
        found, areas = flips.with_areas(solver.solve(random_values(draw)).skin)
        counts.append(int((areas > SMALLEST).sum()))
        slivers += len(found) > 0 and counts[-1] == 0
        worst = max(worst, float(areas.max(initial=0.0)))
    print(f"random combinations with flipped faces: {np.count_nonzero(counts)} of {number}")
    print(f"  at most {max(counts)} of {flips.seen.sum()} visible faces")
    print(
        f"  with flipped slivers of at most {SMALLEST} mm² only: {slivers}; the largest face has {worst:.3f}"
    )


def overlaps(head: Head, solver: FaceSolver, number: int) -> None:
    """Print how deep one lip lies in the other in random combinations."""
    draw, tester = np.random.default_rng(0), LipTester.of(head)
    depths = [tester.overlap(solver.solve(random_values(draw)).skin) for _ in range(number)]
    print(f"lips overlap by at most {max(depths):.3f} mm in {number} random combinations")


def main() -> None:
    """Print what pairs and random combinations do on one head."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--random", type=int, default=10_000)
    parser.add_argument("--head", default="standard")
    parser.add_argument("--lips", action="store_true", help="measure the overlap of the lips instead")
    arguments = parser.parse_args()
    base, _, age = arguments.head.partition("@")
    head = load_head(base, age=float(age) if age else None)
    solver = FaceSolver(head)
    if arguments.lips:
        overlaps(head, solver, arguments.random)
        return
    flips = Flips(head)
    pairs(head, solver, flips)
    combinations(solver, flips, arguments.random)


if __name__ == "__main__":
    main()
