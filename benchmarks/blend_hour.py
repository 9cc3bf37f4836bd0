"""One hour of dense score, three movements a second in each of eight channels, combined at 60 fps.

The aim is 5 s on one core, with memory that grows only with parameters x frames. Run from the repository:
    PYTHONPATH=src OMP_NUM_THREADS=1 python benchmarks/blend_hour.py [--minutes 60] [--conflict inhibit]
"""

from __future__ import annotations

import argparse
import random
import resource
import time
from fractions import Fraction

from risorius import blend
from risorius.core.channels import CHANNELS
from risorius.core.movement import Movement
from risorius.core.parameters import MUSCLES, PARAMETERS, Kind
from risorius.core.score import BlendSettings, Score

PER_SECOND = 3.0
DIRECTIONS = {
    "head": [p.name for p in PARAMETERS if p.kind is Kind.HEAD],
    "gaze": [p.name for p in PARAMETERS if p.kind is Kind.GAZE],
}


def dense_score(seconds: float, conflict: str, seed: int = 1) -> Score:
    """Return overlapping movements of two to five random muscles in all channels but `manual`."""
    draw = random.Random(seed)
    movements = []
    for channel in CHANNELS:
        if channel == "manual":
            continue
        names = DIRECTIONS.get(channel) or [p.name for p in MUSCLES]
        scale = 10.0 if channel in DIRECTIONS else 1.0
        for k in range(int(seconds * PER_SECOND)):
            start = (k + 0.8 * draw.random()) / PER_SECOND
            targets = {
                name: scale * draw.uniform(0.2, 1.0)
                for name in draw.sample(names, draw.randint(1, min(5, len(names))))
            }
            movements.append(Movement(channel, start, start + draw.uniform(0.2, 1.0), 0.1, 0.2, targets))
    return Score(seconds, tuple(movements), settings=BlendSettings(conflict=conflict))


def main() -> None:
    """Measure and print one line."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=60.0)
    options.add_argument("--conflict", default="inhibit")
    chosen = options.parse_args()
    score = dense_score(chosen.minutes * 60.0, chosen.conflict)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    start = time.perf_counter()
    performance = blend.combine(score, Fraction(60))
    elapsed = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(
        f"{chosen.conflict}: {len(score.movements)} movements, {len(performance.values)} frames: "
        f"{elapsed:.2f} s; memory {after - before:.0f} MB above the score's, "
        f"of which the result {performance.values.nbytes / 2**20:.0f} MB"
    )


if __name__ == "__main__":
    main()
