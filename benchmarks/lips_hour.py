"""The lips of an hour of speech at 60 fps: the model of coarticulation alone, and all up to the muscles.

The aim is 1 s of one core for the model: its curves of all articulators. A few sentences
are repeated to fill the time. Run from the repository:
    PYTHONPATH=src OMP_NUM_THREADS=1 python benchmarks/lips_hour.py [--minutes 60] [--lips effort]
"""

from __future__ import annotations

import argparse
import time
from dataclasses import replace
from fractions import Fraction

import numpy as np

from risorius import blend
from risorius.blend.mouth.coarticulation import (
    LIP_MODELS,
    TARGET,
    SegmentAverages,
    SegmentTable,
    SegmentValues,
    without_gaps,
)
from risorius.blend.mouth.shapes import performed
from risorius.core.lips.articulators import ARTICULATORS
from risorius.core.score import Score
from risorius.face.fit.lip_file import load_lip_rig
from risorius.pipeline import compose
from risorius.script import read_script
from risorius.settings import BlendChoices, Settings
from risorius.speech import synthesize_script

FPS, AT_ONCE = 60, 3600
TEXT = "My baby brother put the map by the beam. Five wolves swam over to the boat. Julia prefers popcorn."


def spoken(seconds: float, model: str) -> Score:
    """Return the lips of the text, over and over."""
    script = read_script(TEXT, text=True)
    utterance = synthesize_script(script)
    once = compose(script, utterance, (), Settings(lively=False, blend=BlendChoices("graded", lips=model)))
    times = [k * once.duration for k in range(int(seconds / once.duration))]
    lips = tuple(replace(s, start=s.start + t, end=s.end + t) for t in times for s in once.lips)
    return replace(once, duration=len(times) * once.duration, lips=lips, movements=())


def model_alone(score: Score, name: str) -> float:
    """Return the seconds of one core in which a model finds the curves of all articulators."""
    times = np.arange(0.0, score.duration, 1.0 / FPS)
    segments = performed(without_gaps(score.lips), load_lip_rig())
    start = time.process_time()
    model = LIP_MODELS.get(name)(segments)
    names = [n for n in ARTICULATORS if any(n in s.targets for s in segments[:1000])]
    table = SegmentTable(model, {(TARGET, n): SegmentValues(model.targets(n)) for n in names})
    for first in range(0, len(times), AT_ONCE):
        averages = SegmentAverages(table, times[first : first + AT_ONCE])
        for articulator in names:
            averages(articulator)
    return time.process_time() - start


def whole(score: Score) -> float:
    """Return the seconds of one core for all of the lips, up to the muscles."""
    rig = load_lip_rig()
    start = time.process_time()
    blend.combine(score, Fraction(FPS), rig)
    return time.process_time() - start


def main() -> None:
    """Measure and print the model and all of the lips."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--lips", default="effort")
    options = parser.parse_args()
    score = spoken(options.minutes * 60.0, options.lips)
    alone, everything = model_alone(score, options.lips), whole(score)
    print(f"{options.lips}: {len(score.lips)} segments")
    print(f"the model: {alone:.2f} s of one core; all of the lips: {everything:.2f} s")


if __name__ == "__main__":
    main()
