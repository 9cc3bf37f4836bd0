"""A minute of speech, twelve segments a second, with a smile and blinks, planned at 30 fps.

The aim is 0.1 s on one core. Run from the repository:
    PYTHONPATH=src OMP_NUM_THREADS=1 python benchmarks/blend_minute.py [--minutes 1]
"""

from __future__ import annotations

import argparse
import random
import time
from fractions import Fraction

from risorius import blend
from risorius.core.movement import Dominance, LipSegment, Movement
from risorius.core.score import BlendSettings, Score

VOWEL = {"*": Dominance(1.0, 0.05, 0.05)}
CONSONANT = {"masseter": Dominance(1.5, 0.035, 0.035), "*": Dominance(0.8, 0.035, 0.035)}
LABIAL = {"masseter": Dominance(2.0, 0.03, 0.03), "*": Dominance(4.0, 0.03, 0.03)}
MOUTH = ("depressor_labii.left", "depressor_labii.right", "risorius.left", "risorius.right", "tongue_up")
OPENERS = dict.fromkeys(("masseter", *MOUTH[:2], "levator_labii_superioris.left"), (0.0, 0.1))


def segment(draw: random.Random, start: float, end: float) -> LipSegment:
    """Return a random vowel, consonant or labial."""
    targets = {name: draw.uniform(0.0, 0.5) for name in ("masseter", *MOUTH)}
    kind = draw.choice("vvccr" + "m")
    if kind == "m":
        return LipSegment("M", start, end, {**targets, "lip_seal": 1.0}, OPENERS, LABIAL)
    if kind == "r":
        return LipSegment("UW", start, end, {**targets, "orbicularis_oris_funneler": 0.8}, {}, VOWEL)
    limits = {"orbicularis_oris_presser": (0.0, 0.1), "masseter": (0.0, 0.8)}
    return LipSegment("AH", start, end, targets, limits, VOWEL if kind == "v" else CONSONANT)


def speech(minutes: float, conflict: str, seed: int = 1) -> Score:
    """Return a spoken score."""
    draw = random.Random(seed)
    lips, start = [], 0.0
    while start < minutes * 60.0:
        end = start + draw.uniform(0.04, 0.126)
        lips.append(segment(draw, start, end))
        start = end
    smile = {"zygomatic_major.left": 0.8, "zygomatic_major.right": 0.8, "masseter": 0.3}
    blink = {"orbicularis_oculi_palpebralis.left": 1.0, "orbicularis_oculi_palpebralis.right": 1.0}
    movements = [
        Movement("emotion", k * 10.0, k * 10.0 + 8.0, 0.45, 0.75, smile) for k in range(int(start / 10))
    ]
    movements += [
        Movement("manipulators", k * 3.0, k * 3.0 + 0.25, 0.1, 0.12, blink) for k in range(int(start / 3))
    ]
    return Score(start, tuple(movements), tuple(lips), settings=BlendSettings(conflict=conflict))


def main() -> None:
    """Measure and print one line for each policy."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--minutes", type=float, default=1.0)
    minutes = options.parse_args().minutes
    for conflict in ("inhibit", "graded", "attenuate", "sum"):
        score = speech(minutes, conflict)
        times = []
        for _ in range(3):
            start = time.perf_counter()
            blend.combine(score, Fraction(30))
            times.append(time.perf_counter() - start)
        print(f"{conflict}: {len(score.lips)} segments, {score.duration:.0f} s of speech: {min(times):.3f} s")


if __name__ == "__main__":
    main()
