"""The laws of the face on every head: `python benchmarks/heads_sweep.py [HEAD[@AGE][+SLIDER:VALUE] ...]`.

Without heads every one that is shipped, at three ages beside its own; `--sliders` adds the ends of sliders.

Columns, in mm: least R² and greatest error of a muscle alone, lips' contact included; overshoot of two
muscles together beyond the larger; lips' widest gap at rest; lips' overlap for all mouth muscles and their
pairs (every `--step`-th), and for every fifth random combination free of conflicts; opening left by a full
seal at jaw 0 to 0.2 under six emotions and all random combinations, and overlap there; gap of closed lids
under these, and their least clearance over the eyeball in blinks; the tucked lip's distance from the teeth's
edge; the deepest tooth in the lips' skin at rest; poses with turned faces (of muscles, their pairs, emotions,
and the random combinations open and sealed), and the most in one.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from tests.face.conftest import EMOTIONS, MOUTH_MUSCLES  # noqa: E402
from tests.face.laws import BLINK, Laws  # noqa: E402
from tests.face.poses import BASES, contracted, random_values  # noqa: E402

from risorius.core.parameters import INDEX  # noqa: E402
from risorius.face.head.head import load_head, shipped_heads  # noqa: E402
from risorius.face.head.sliders import parse_slider, slider_names  # noqa: E402

AGES = (25, 50, 75)
JAWS = (0.0, 0.1, 0.2)
TUCKED = ("none", "happiness", "disgust", "fear")
OVERLAPS = 5  # overlap takes long: of so many random combinations one is looked at
WIDTH = 8
COLUMNS = {  # of what is measured, and how many decimals are told
    "R2": 4,
    "error": 3,
    "over": 2,
    "rest": 2,
    "lips": 3,
    "random": 3,
    "seal": 3,
    "sealed": 3,
    "lids": 3,
    "clear": 2,
    "tuck y": 2,
    "tuck z": 2,
    "teeth": 2,
}


def sealed(values: np.ndarray, draw: np.random.Generator) -> np.ndarray:
    """Return values (46,) with lips and lids closed and the jaw at most at 0.2."""
    closed = values.copy()
    closed[INDEX["masseter"]] = draw.choice(JAWS)
    closed[INDEX["lip_seal"]] = 1.0
    closed[[INDEX[f"{BLINK}.{side}"] for side in ("left", "right")]] = 1.0
    return closed


def together(laws: Laws, step: int, poses: int) -> tuple[dict[str, float], list[int]]:
    """Return what lips and lids do in many poses, and how many faces are turned over in each."""
    draw = np.random.default_rng(4)
    mixed = [random_values(draw) for _ in range(poses)]
    closed = [sealed(values, draw) for values in mixed]
    singles = [{m: 1.0} for m in MOUTH_MUSCLES]
    pairs = [{a: 1.0, b: 1.0} for a, b in itertools.combinations(MOUTH_MUSCLES, 2)][::step]
    shut = [
        emotion | {"masseter": jaw, "lip_seal": 1.0}
        for emotion, jaw in itertools.product(EMOTIONS.values(), JAWS)
    ]
    every = [contracted(pair) for pair in itertools.combinations(BASES, 2)][::step]
    measured = {
        "lips": max(map(laws.overlap, (*singles, *pairs))),
        "random": max(map(laws.overlap, mixed[::OVERLAPS]), default=0.0),
        "seal": max(map(laws.opening, (*shut, *closed))),
        "sealed": max(map(laws.overlap, (*shut, *closed[::OVERLAPS]))),
        "lids": max([laws.lids_apart(), *(laws.between_lids(laws.face(v).skin) for v in closed)]),
    }
    shown = (*singles, {"masseter": 1.0}, *every, *EMOTIONS.values(), *mixed)
    return measured, [*map(laws.turned, shown), *map(laws.flipped, closed)]


def row(name: str, step: int, poses: int) -> list[str]:
    """Return the cells of one head's row."""
    start = time.perf_counter()
    whole, *sliders = name.split("+")
    base, _, age = whole.partition("@")
    shape = dict(map(parse_slider, sliders))
    laws = Laws(load_head(base, age=float(age) if age else None, shape=shape))
    measured, turned = together(laws, step, poses)
    measured["R2"], measured["error"] = laws.alone()
    measured["over"], measured["rest"] = laws.overshoot(), laws.rest_gap()
    measured["clear"], measured["teeth"] = laws.lid_clearance(), laws.teeth_in_lips()
    tucks = [laws.tuck(EMOTIONS.get(emotion, {})) for emotion in TUCKED]
    measured["tuck y"], measured["tuck z"] = np.max(tucks, axis=0)
    numbers = [f"{measured[column]:.{decimals}f}" for column, decimals in COLUMNS.items()]
    counts = [f"{sum(t > 0 for t in turned)}/{len(turned)}", str(max(turned))]
    return [name, *numbers, *counts, f"{time.perf_counter() - start:.0f}"]


def line(cells: list[str]) -> str:
    """Return a line of the table."""
    return "".join(f"{c:26}" if k == 0 else f"{c:>{WIDTH}}" for k, c in enumerate(cells))


def main() -> None:
    """Print a row for each head."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*")
    parser.add_argument("--step", type=int, default=1, help="take every n-th pair of muscles")
    parser.add_argument("--poses", type=int, default=60, help="random combinations for each head")
    parser.add_argument(
        "--sliders", action="store_true", help="every slider at -1 and 1 on the standard head"
    )
    options = parser.parse_args()
    if options.sliders:
        options.heads += [f"standard+{name}:{end}" for name in slider_names() for end in (-1, 1)]
    every = [name + at for name in shipped_heads() for at in ("", *(f"@{age}" for age in AGES))]
    print(line(["head", *COLUMNS, "turned", "most", "s"]))
    for name in options.heads or every:
        print(line(row(name, options.step, options.poses)), flush=True)


if __name__ == "__main__":
    main()
