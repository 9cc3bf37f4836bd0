"""Do curves jump, or have corners? How far their differences fall when they are sampled four times as often.

The largest first difference of a curve falls 4-fold, at a jump not at all; the largest second difference
falls 16-fold where it bends, 4-fold at a corner. Curves of lids and eyes, whose movements take some 30 ms,
are sampled 400 and 1600 times a second, all others 100 and 400 times. Run from the repository (some minutes):
    PYTHONPATH=src python benchmarks/corners.py [--sentences 60] [--displays fear] [--strengths 0.5 1]
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import NamedTuple

import numpy as np

from risorius import blend
from risorius.blend.rounding import is_quick
from risorius.channels import Display
from risorius.core.parameters import NAMES
from risorius.face.fit.lip_file import load_lip_rig
from risorius.pipeline import compose
from risorius.script import read_script
from risorius.settings import Settings
from risorius.speech import synthesize_script

SENTENCES = Path(__file__).with_name("lips_sentences.txt").read_text().splitlines()
DISPLAYS = ("none", "anger", "disgust", "fear", "happiness", "sadness", "surprise")
FIRST, SECOND = 3.0, 8.0
"""How many times first and second differences fall at least."""
STILL = 1e-5
"""A curve whose second differences are smaller is at rest."""
COARSE, FINE, FINEST = 100, 400, 1600
QUICK = frozenset(filter(is_quick, NAMES))
"""Parameters that are sampled four times as often as the others."""


class Falls(NamedTuple):
    """How many times the largest first and second differences of a curve fall."""

    name: str
    first: float
    second: float

    @property
    def holds(self) -> bool:
        return self.first >= FIRST and self.second >= SECOND


def falls(plan: blend.Plan) -> Iterator[Falls]:
    """Yield what every curve of a plan that moves does."""
    duration = plan.score.duration
    curves = {
        rate: plan.at(np.arange(0.0, duration, 1.0 / rate), QUICK if rate == FINEST else NAMES)
        for rate in (COARSE, FINE, FINEST)
    }
    for column, name in enumerate(NAMES):
        rates = (FINE, FINEST) if name in QUICK else (COARSE, FINE)
        first, second = (
            [float(np.abs(np.diff(curves[rate][:, column], order)).max()) for rate in rates]
            for order in (1, 2)
        )
        if second[0] > STILL:
            yield Falls(name, first[0] / first[1], second[0] / second[1])


def main() -> None:
    """Print every curve that does not fall as it should, then the least falls of every parameter."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sentences", type=int, default=len(SENTENCES))
    parser.add_argument("--displays", nargs="+", default=DISPLAYS)
    parser.add_argument("--strengths", nargs="+", type=float, default=(0.5, 1.0))
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    found: dict[str, list[Falls]] = defaultdict(list)
    rig, settings = load_lip_rig(), Settings(seed=options.seed)
    for number, sentence in enumerate(SENTENCES[: options.sentences]):
        script = read_script(sentence, text=True)
        utterance = synthesize_script(script)
        for display, strength in product(options.displays, options.strengths):
            shown = () if display == "none" else (Display(display, strength),)
            plan = blend.Plan(compose(script, utterance, shown, settings), rig)
            for one in falls(plan):
                found[one.name].append(one)
                if not one.holds:
                    what = f"{display} {strength:g}, sentence {number}"
                    print(f"{one.name:30s} {one.first:5.2f} {one.second:5.2f}  {what}", flush=True)
    everything = [one for curves in found.values() for one in curves]
    print(f"{len(everything)} curves, {sum(not one.holds for one in everything)} with a corner or a jump")
    for name, curves in sorted(found.items(), key=lambda item: min(one.second for one in item[1])):
        least = min(one.first for one in curves), min(one.second for one in curves)
        print(f"{name:30s} {least[0]:5.2f} {least[1]:5.2f}")


if __name__ == "__main__":
    main()
