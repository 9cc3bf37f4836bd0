"""How much the timing of phones matters to the lips, on hand-labelled speech; and figures of people's lips.

FOLDER is laid out as TIMIT (`SPEAKER/SENTENCE.phn`, times in samples at 16 kHz). The lips are driven from the
hand labels, and from labels whose boundaries are moved at random by up to ±20 ms; r is between the two curves
of the lip gap, on the mesh at 50 fps. Run from the repository:
    PYTHONPATH=src python benchmarks/lips_timing.py FOLDER [--sentences 16]
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from lips_measures import machine

from risorius import blend
from risorius.channels import Brief, compose
from risorius.core.audio import silence
from risorius.core.utterance import Phone, Utterance
from risorius.face.lip_fit import load_lip_rig

RATE, FPS = 16_000, 50.0
JITTER = 0.02
SHORTEST = 0.005
CHANNELS = ("emotion", "signals", "punctuators", "regulators", "manipulators", "gaze", "head")
SILENT = ("h#", "pau", "epi")
# TIMIT's labels that are not ARPAbet's.
LIKE = {
    "ax": "AH", "ax-h": "AH", "ix": "IH", "axr": "ER", "ux": "UW", "hv": "HH", "dx": "D", "nx": "N", "q": "",
    "em": "M", "en": "N", "eng": "NG", "el": "L",
    "bcl": "B", "pcl": "P", "dcl": "D", "tcl": "T", "gcl": "G", "kcl": "K",
}  # fmt: skip
VOWELS = frozenset(["AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW"])

Spans = list[tuple[str, float, float]]


def labels(path: Path) -> Spans:
    """Return phones and their seconds; a closure and its release are one phone, glottal stops none."""
    found: Spans = []
    for line in path.read_text().split("\n"):
        if not line.strip():
            continue
        first, last, label = line.split()
        symbol = "" if label in SILENT else LIKE.get(label, label.upper())
        start, end = int(first) / RATE, int(last) / RATE
        joins = found and (found[-1][0] == symbol or label == "q" or found[-1][0] + label in ("TCH", "DJH"))
        if joins:
            kept = found.pop()
            found.append((symbol if label in ("ch", "jh") else kept[0], kept[1], end))
        else:
            found.append((symbol, found[-1][2] if found else 0.0, end if found else max(end, start)))
    return found


def moved(spans: Spans, draw: np.random.Generator) -> Spans:
    """Return the phones with every inner boundary moved at random, in order still."""
    edges = np.array([start for _, start, _ in spans[1:]]) + draw.uniform(-JITTER, JITTER, len(spans) - 1)
    edges = np.maximum.accumulate(np.maximum(edges, SHORTEST))
    last = spans[-1][2]
    times = [0.0, *np.minimum(edges, last - SHORTEST).tolist(), last]
    kept = zip(spans, times[:-1], times[1:], strict=True)
    return [(symbol, start, end) for (symbol, _, _), start, end in kept if end > start]


def gap(spans: Spans) -> np.ndarray:
    """Return the lip gap in mm at 50 fps."""
    last = spans[-1][2]
    phones = tuple(Phone(symbol, start, end, 1 if symbol in VOWELS else -1) for symbol, start, end in spans)
    utterance = Utterance("", "en-us", silence(last, RATE), phones, ())
    score = compose(Brief(last, utterance, lively=False), without=CHANNELS)
    return machine().mouth(blend.at(score, np.arange(0.0, last, 1.0 / FPS), load_lip_rig()))[:, 0]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sentences", type=int, default=16)
    options = parser.parse_args()
    paths = sorted(options.folder.glob("*/*.phn"))
    chosen = paths[:: max(len(paths) // options.sentences, 1)][: options.sentences]
    draw = np.random.default_rng(0)
    found = []
    for path in chosen:
        spans = labels(path)
        found.append(float(np.corrcoef(gap(spans), gap(moved(spans, draw)))[0, 1]))
    print(
        f"{len(found)} sentences, boundaries moved by up to ±{1000 * JITTER:.0f} ms: lip gap r "
        f"mean {np.mean(found):.3f}, least {min(found):.3f}"
    )


if __name__ == "__main__":
    main()
