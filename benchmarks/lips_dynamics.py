"""How fast the lips move, at any rate of speech: people's lip gap peaks at 120 to 320 mm a second.

Prints, by rate and model, the 99.9th percentile of the lip gap's speed on the mesh, and how kinked it is:
the largest change of its speed within 5 ms while the lips are apart. Run from the repository (a few minutes):
    PYTHONPATH=src python benchmarks/lips_dynamics.py [--sentences 6]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from lips_measures import machine

from risorius import blend
from risorius.face.lip_file import load_lip_rig
from risorius.pipeline import compose
from risorius.script import read_script
from risorius.settings import BlendChoices, Settings
from risorius.speech import say

SENTENCES = Path(__file__).with_name("lips_sentences.txt").read_text().splitlines()
RATES = (110, 175, 250, 350)
MODELS = ("effort", "dominance", "lookahead")
STEP = 0.005


def gaps(sentence: str, rate: int, model: str) -> np.ndarray:
    """Return the lip gap in mm every `STEP` seconds."""
    script = read_script(sentence, text=True)
    utterance = say(script, rate=rate)
    settings = Settings(lively=False, blend=BlendChoices(lips=model))
    score = compose(script, utterance, (), settings)
    values = blend.at(score, np.arange(0.0, score.duration, STEP), load_lip_rig())
    return machine().mouth(values)[:, 0]


def _kink(curve: np.ndarray) -> float:
    """Return the largest change of speed from step to step, mm/s; lips that meet stop at once."""
    apart = (curve[:-2] > 0.0) & (curve[1:-1] > 0.0) & (curve[2:] > 0.0)
    return float(np.abs(np.diff(np.diff(curve)))[apart].max() / STEP)


def main() -> None:
    """Measure and print one line for each rate and model."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sentences", type=int, default=6)
    options = parser.parse_args()
    for model in MODELS:
        for rate in RATES:
            curves = [gaps(sentence, rate, model) for sentence in SENTENCES[: options.sentences]]
            speed = np.concatenate([np.abs(np.diff(curve)) / STEP for curve in curves])
            kink = max(_kink(curve) for curve in curves)
            print(
                f"{model:10s} {rate:4d} words/min: 99.9th percentile {np.percentile(speed, 99.9):4.0f} mm/s, "
                f"most {speed.max():4.0f}; speed changes by at most {kink:4.0f} mm/s in 5 ms",
                flush=True,
            )


if __name__ == "__main__":
    main()
