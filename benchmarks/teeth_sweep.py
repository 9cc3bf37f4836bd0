"""Lips and tongue against the teeth in what is said: `python benchmarks/teeth_sweep.py [HEAD[@AGE] ...]`.

Every `--step`-th frame of two demonstration sentences: one under surprise and then happiness, one under each
emotion at full strength. Columns, in mm: deepest tooth in the lips' or cheeks' flesh, deepest lip in a tooth,
deepest tongue in the upper and in the lower teeth; 0.3 are allowed (issue: the face). Then the worst frames.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from tests.face.teeth import TeethTester  # noqa: E402

from risorius.api import speak  # noqa: E402
from risorius.channels import Display  # noqa: E402
from risorius.core.parameters import NAMES  # noqa: E402
from risorius.face.head.head import load_head, shipped_heads  # noqa: E402
from risorius.face.solve import FaceSolver  # noqa: E402
from risorius.rules.emotions import emotions  # noqa: E402

GREETING = "Oh, really? I like it very much."
CLOSURES = "My baby brother put the map by the beam."
COLUMNS = ("teeth in lips", "lips in teeth", "tongue in upper", "tongue in lower")


def spoken(step: int) -> dict[str, np.ndarray]:
    """Return the values (n, 46) of every `step`-th frame by what is said."""
    displays = (Display("surprise", 1.0, 0.0, 2.0), Display("happiness", 1.0, 1.0, 4.0))
    takes = {"greeting": speak(GREETING, text=True, emotion=displays)}
    takes |= {name: speak(CLOSURES, text=True, emotion={name: 1.0}) for name in emotions()}
    return {name: take.performance.values[::step] for name, take in takes.items()}


def main() -> None:
    """Print a row for each head."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("heads", nargs="*", default=shipped_heads())
    parser.add_argument("--step", type=int, default=3)
    options = parser.parse_args()
    clips = spoken(options.step)
    print(f"{'head':14}" + "  ".join(f"{name:>15}" for name in COLUMNS))
    for name in options.heads:
        base, _, age = name.partition("@")
        head = load_head(base, age=float(age) if age else None)
        tester, solver = TeethTester(head), FaceSolver(head)
        depths, frames = [], []
        for clip, values in clips.items():
            for number, row in enumerate(values):
                frame = solver.solve(row)
                depths.append([tester.in_lips(frame), tester.lips_in(frame), *tester.tongue_in(frame)])
                frames.append((clip, number * options.step, row))
        found = np.array(depths)
        print(f"{name:14}" + "  ".join(f"{depth:15.2f}" for depth in found.max(axis=0)), flush=True)
        for column, title in enumerate(COLUMNS):
            worst = int(found[:, column].argmax())
            if found[worst, column] > 0.3:
                clip, number, row = frames[worst]
                acting = {n: round(float(v), 2) for n, v in zip(NAMES, row, strict=True) if 0.1 < v <= 1.0}
                print(f"    {title} {found[worst, column]:.2f}: {clip}, frame {number}: {acting}")


if __name__ == "__main__":
    main()
