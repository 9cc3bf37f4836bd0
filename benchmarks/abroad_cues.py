"""Closures in the formats of visemes, for `abroad.py`: what they show where our own lips are sealed."""

from __future__ import annotations

import csv
import json
from bisect import bisect_right
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from abroad_readers import Glb, MissingReaderError

from risorius.core.arrays import Array, BoolArray

OPEN = ("aa", "E", "ih", "oh", "ou")
PRESETS = ("aa", "ih", "ou", "ee", "oh")


@dataclass(frozen=True)
class Closures:
    """The visemes in the frames in which our lips are sealed.

    `frames`: their number; `least`, `most`: the least weight of `PP` and the greatest of the open vowels in
    `.oculus.csv`; `preset`: the greatest of VRM's vowels in `.vrma`, or None without a reader; `shape` and
    `event`: in how many frames `.visemes.json` has A and `.azure.json` 21.
    """

    frames: int
    least: float
    most: float
    preset: float | None
    shape: int
    event: int


def closures_in_visemes(folder: Path, times: Array, sealed: BoolArray) -> Closures:
    """Read the three files in `folder` at the sealed frames of `times` (frames,) in seconds."""
    with (folder / "x.oculus.csv").open(newline="") as file:
        rows = [row for row, shut in zip(csv.DictReader(file), sealed, strict=True) if shut]
    mouths = json.loads((folder / "x.visemes.json").read_text())["mouthCues"]
    shapes = _at(times[sealed], [cue["start"] for cue in mouths], [cue["value"] for cue in mouths])
    events = json.loads((folder / "x.azure.json").read_text())["visemes"]
    starts, ids = [event["AudioOffset"] / 1e7 for event in events], [event["VisemeId"] for event in events]
    return Closures(
        len(rows),
        min((float(row["PP"]) for row in rows), default=1.0),
        max((float(row[name]) for row in rows for name in OPEN), default=0.0),
        _greatest_vowel(folder / "x.vrma", sealed),
        shapes.count("A"),
        _at(times[sealed], starts, ids).count(21),
    )


def _greatest_vowel(path: Path, sealed: BoolArray) -> float | None:
    try:
        glb = Glb(path)
    except MissingReaderError:
        return None
    vowels = np.stack([glb.translations(glb.names[name])[:, 0] for name in PRESETS], axis=1)
    return float(vowels[: len(sealed)][sealed].max(initial=0.0))


def _at(times: Array, starts: list[float], values: list) -> list:
    return [values[max(bisect_right(starts, time + 1e-6) - 1, 0)] for time in times]


def show(closures: list[Closures]) -> None:
    """Print a line for each format."""
    frames = sum(each.frames for each in closures)
    least, most = min(each.least for each in closures), max(each.most for each in closures)
    print(f"\nVisemes in the {frames} frames in which our lips are sealed:")
    print(f".oculus.csv   PP is {least:.2f} at least, a vowel {most:.2f} at most")
    presets = [each.preset for each in closures if each.preset is not None]
    if presets:
        print(f".vrma         a preset of a vowel is {max(presets):.2f} at most")
    print(f".visemes.json A in {sum(each.shape for each in closures)}")
    print(f".azure.json   21 in {sum(each.event for each in closures)}")
