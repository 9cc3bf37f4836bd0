"""The laws of the face: `python benchmarks/heads_sweep.py [HEAD[@AGE][+SLIDER:VALUE] ...]`.

Without heads every one that is shipped, at three ages beside its own; `--sliders` adds the ends of sliders.

Columns: lips' gap at rest (mm, widest), lips' overlap for all mouth muscles, their pairs (every `--step`-th)
and random poses; opening left by a full seal at jaw 0, 0.1, 0.2 under six emotions and overlap there; gap of
closed lids and least clearance over the eyeball in blinks; the tucked lip's distance from the teeth's edge;
turned faces (poses with any, and the most in one); the deepest tooth in the lips' skin at rest.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from face.conftest import EMOTIONS, MOUTH_MUSCLES  # noqa: E402
from face.laws import Laws  # noqa: E402
from risorius.face.head import load_head, shipped_heads  # noqa: E402
from risorius.face.sliders import parse_slider, slider_names  # noqa: E402

AGES = (25, 50, 75)
HEADER = (
    "head",
    "rest",
    "single",
    "pairs",
    "random",
    "seal",
    "sealed",
    "lids",
    "clear",
    "tuck y",
    "tuck z",
    "turned",
    "most",
    "teeth",
    "s",
)


def row(name: str, step: int, poses: int) -> list[str]:
    start = time.perf_counter()
    whole, *sliders = name.split("+")
    base, _, age = whole.partition("@")
    shape = dict(map(parse_slider, sliders))
    laws = Laws(load_head(base, age=float(age) if age else None, shape=shape))
    singles = [{m: 1.0} for m in MOUTH_MUSCLES]
    pairs = [{a: 1.0, b: 1.0} for a, b in itertools.combinations(MOUTH_MUSCLES, 2)][::step]
    rng = np.random.default_rng(4)
    mixed = []
    for _ in range(poses):
        chosen = rng.choice(MOUTH_MUSCLES, 4, replace=False)
        targets = dict(zip(chosen.tolist(), rng.uniform(0.0, 1.0, 4), strict=True))
        mixed.append(targets | {"masseter": rng.uniform(0.0, 0.2), "lip_seal": rng.choice([0.0, 0.5, 1.0])})
    sealed = [
        t | {"masseter": jaw, "lip_seal": 1.0}
        for t, jaw in itertools.product(EMOTIONS.values(), (0.0, 0.1, 0.2))
    ]
    y, z = np.max([laws.tuck(EMOTIONS.get(e, {})) for e in ("none", "happiness", "disgust", "fear")], axis=0)
    turned = [laws.turned(t) for t in (*singles, *pairs, *EMOTIONS.values(), {"masseter": 1.0})]
    cells = [
        laws.rest_gap(),
        max(map(laws.overlap, singles)),
        max(map(laws.overlap, pairs)),
        max(map(laws.overlap, mixed), default=0.0),
        max(map(laws.opening, sealed)),
        max(map(laws.overlap, sealed)),
        laws.lids_apart(),
        laws.lid_clearance(),
        y,
        z,
    ]
    numbers = [f"{cell:.3f}" for cell in cells]
    counts = [f"{sum(t > 0 for t in turned)}/{len(turned)}", str(max(turned))]
    return [name, *numbers, *counts, f"{laws.teeth_in_lips():.2f}", f"{time.perf_counter() - start:.0f}"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*")
    parser.add_argument("--step", type=int, default=1, help="take every n-th pair of muscles")
    parser.add_argument("--poses", type=int, default=60, help="random poses for each head")
    parser.add_argument(
        "--sliders", action="store_true", help="every slider at -1 and 1 on the standard head"
    )
    options = parser.parse_args()
    if options.sliders:
        options.heads += [f"standard+{name}:{end}" for name in slider_names() for end in (-1, 1)]
    every = [name + at for name in shipped_heads() for at in ("", *(f"@{age}" for age in AGES))]
    print("  ".join(f"{cell:>28}" if k == 0 else f"{cell:>7}" for k, cell in enumerate(HEADER)))
    for name in options.heads or every:
        cells = row(name, options.step, options.poses)
        print("  ".join(f"{c:>28}" if k == 0 else f"{c:>7}" for k, c in enumerate(cells)), flush=True)


if __name__ == "__main__":
    main()
