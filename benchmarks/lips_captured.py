"""Our lips beside captured ones: what the three models reach.

FOLDER holds one folder an item: `audio.wav`, `labels.TextGrid` (phones and words), `motion.csv` with
`time_s`, `gap_mm`, and `jaw_mm` (coils) or `chin_mm` (video). Prints for each item the correlation of the gap
at the best lag within ±150 ms (above 0: ours is late), of the jaw, the depth of the gap's alternation at 3 to
8 Hz relative to theirs (of the video's relative to each one's deviation), and the labials whose least gap
lies within 30 ms.
Run from the repository (a minute a model):
    PYTHONPATH=src python benchmarks/lips_captured.py FOLDER [--lips effort dominance lookahead]
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path
from typing import NamedTuple

import numpy as np

from risorius import pipeline
from risorius.core.arrays import Array
from risorius.core.speech.utterance import Phone, Utterance
from risorius.settings import BlendChoices, Settings
from risorius.speech import LabelledRecording, align_recording

FPS, FINE = 100, 0.001
MODELS = ("effort", "dominance", "lookahead")
UPPER, LOWER = 62, 66
"""The middles of the inner lips among the 68 points."""
LABIALS = ("P", "B", "M")
WITHIN, NEAR, BESIDE = 0.15, 0.03, 0.12


class Row(NamedTuple):
    """What one item reaches; `lag` in seconds, `hits` of `labials`."""

    coils: bool
    r: float
    lag: float
    jaw_r: float
    depth: float
    hits: int
    labials: int


def motion(path: Path) -> dict[str, Array]:
    """Return the columns of a `motion.csv` by name, (n,) each."""
    first, *rows = csv.reader(path.read_text().splitlines())
    return dict(zip(first, np.array([[float(x or "nan") for x in row] for row in rows]).T, strict=True))


def ours(utterance: Utterance, item: Path, model: str) -> tuple[Array, Array, Array]:
    """Return times, the gap between the inner lips and the jaw's drop in mm, (n,) each."""
    settings = Settings(fps=FPS, seed=1, blend=BlendChoices(lips=model))
    script, _ = align_recording(LabelledRecording(str(item / "labels.TextGrid"), str(item / "audio.wav")))
    take = pipeline.combine(pipeline.compose(script, utterance, (), settings), settings, utterance)
    rows = np.array([take.measures(frame) for frame in take.faces(reuse=True)], dtype=np.float64)
    points = rows[:, -68 * 3 :].reshape(-1, 68, 3)
    return take.times, np.maximum(points[:, UPPER, 1] - points[:, LOWER, 1], 0.0), rows[:, 3]


def best(theirs: Array, mine: Array, step: float) -> tuple[float, float]:
    """Return the highest correlation over shifts, and its lag in seconds."""
    found = []
    for k in range(-round(WITHIN / step), round(WITHIN / step) + 1):
        a, b = theirs[max(0, -k) : len(theirs) - max(0, k)], mine[max(0, k) : len(mine) - max(0, -k)]
        found.append((float(np.corrcoef(a, b)[0, 1]), k * step))
    return max(found)


def alternation(curve: Array) -> float:
    """Return the standard deviation of a curve at `FPS` between 3 and 8 Hz."""
    frequency, spectrum = np.fft.rfftfreq(len(curve), 1 / FPS), np.fft.rfft(curve - curve.mean())
    spectrum[(frequency < 3.0) | (frequency > 8.0)] = 0.0
    return float(np.fft.irfft(spectrum, len(curve)).std())


def in_time(phone: Phone, times: Array, theirs: Array, mine: Array) -> bool:
    """Return whether the middle of our lowest gap is near the moment of theirs in a labial."""
    said = (times >= phone.start - NEAR) & (times <= phone.end + NEAR)
    when = times[said][np.argmin(theirs[said])]
    around = abs(times - when) <= BESIDE
    low = mine[around] <= mine[around].min() + 0.05 * np.ptp(mine[around])
    return bool(abs(times[around][low].mean() - when) <= NEAR)


def measure(item: Path, model: str) -> Row:
    """Return what a model reaches on an item."""
    theirs = motion(item / "motion.csv")
    _, utterance = align_recording(LabelledRecording(str(item / "labels.TextGrid"), str(item / "audio.wav")))
    spoken = [phone for phone in utterance.phones if phone.symbol]
    times, gap, jaw = ours(utterance, item, model)
    coils = "jaw_mm" in theirs
    at = np.arange(spoken[0].start, spoken[-1].end, 1 / FPS)
    fine = np.arange(at[0], at[-1], FINE)

    def both(name: str, mine: Array, when: Array) -> tuple[Array, Array]:
        return np.interp(when, theirs["time_s"], theirs[name]), np.interp(when, times, mine)

    a, b = both("gap_mm", gap, at)
    depth = alternation(b) / alternation(a) * (1.0 if coils else a.std() / b.std())
    labials = [phone for phone in spoken if phone.symbol in LABIALS]
    hits = sum(in_time(phone, at, a, b) for phone in labials)
    r, lag = best(*both("gap_mm", gap, fine), FINE)
    jaw_r, _ = best(*both("jaw_mm" if coils else "chin_mm", jaw, at), 1 / FPS)
    return Row(coils, r, lag, jaw_r, depth, hits, len(labials))


def main() -> None:
    """Measure and print, and say what holds."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--lips", nargs="+", choices=MODELS, default=MODELS)
    options = parser.parse_args()
    for model in options.lips:
        items = sorted(path.parent for path in options.folder.glob("*/motion.csv"))
        rows = []
        for item in items:
            rows.append(row := measure(item, model))
            print(
                f"{model:10s} {item.name:14s} r {row.r:.2f}  lag {1000 * row.lag:+4.0f} ms  "
                f"jaw r {row.jaw_r:.2f}  depth {row.depth:.2f}  labials {row.hits}/{row.labials}",
                flush=True,
            )
        coils = [row for row in rows if row.coils]
        share = sum(row.hits for row in rows) / sum(row.labials for row in rows)
        asked = {
            f"depth beside coils .8 to 1.2: {', '.join(f'{row.depth:.2f}' for row in coils)}": all(
                0.8 <= row.depth <= 1.2 for row in coils
            ),
            "lag beside coils at most 15 ms": all(abs(row.lag) <= 0.015 for row in coils),
            f"labials in time 70 %: {100 * share:.0f} %": share >= 0.7,
            f"mean r .75 (aim): {(mean := np.mean([row.r for row in rows])):.2f}": mean >= 0.75,
            f"mean r of the jaw .60 (aim): {(jaw := np.mean([row.jaw_r for row in rows])):.2f}": jaw >= 0.6,
        }
        for what, holds in asked.items():
            print(f"  {'ok  ' if holds else 'FAIL'} {what}")


if __name__ == "__main__":
    main()
