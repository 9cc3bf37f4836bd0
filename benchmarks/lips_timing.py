"""How much the timing of phones matters to the lips, on hand-labelled speech.

The lips are driven from labels by hand, from labels whose boundaries are moved at random by up to ±20 ms, and
from our own alignment of the recording with its words; r is between the curves of the lip gap, on the mesh at
50 fps. Every vowel counts as stressed, so that timing alone is compared. FOLDER is laid out as TIMIT
(`timit.py`). Run from the repository:
    PYTHONPATH=src python benchmarks/lips_timing.py FOLDER [--sentences 16]
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from lips_measures import machine
from timit import GLOTTAL, RATE, Label, sentences

from risorius import blend
from risorius.channels import ChannelInputs, compose
from risorius.core.channels import CHANNELS
from risorius.core.speech.audio import silence
from risorius.core.speech.utterance import Phone, Utterance
from risorius.face.fit.lip_file import load_lip_rig
from risorius.languages import phonesets
from risorius.speech.alignment import align
from risorius.speech.recordings.recording import read_recording

FPS = 50.0
JITTER = 0.02
SHORTEST = 0.005
ASKED = 0.97


def moved(labels: Sequence[Label], draw: np.random.Generator) -> list[Label]:
    """Return the phones with every inner boundary moved at random, in order still."""
    last = labels[-1].end
    edges = np.array([label.start for label in labels[1:]]) + draw.uniform(-JITTER, JITTER, len(labels) - 1)
    edges = np.maximum.accumulate(np.clip(edges, SHORTEST, last - SHORTEST))
    times = [0.0, *edges.tolist(), last]
    pairs = zip(labels, times[:-1], times[1:], strict=True)
    return [Label(label.symbol, start, end) for label, start, end in pairs if end > start]


def gap(labels: Sequence[Label], seconds: float) -> np.ndarray:
    """Return the lip gap in mm at 50 fps over the first `seconds`."""
    phones: list[Phone] = []
    for symbol, _, end in labels:
        start = phones[-1].end if phones else 0.0
        stress = 1 if symbol and phonesets.is_vowel(symbol) else -1
        phones.append(Phone("" if symbol == GLOTTAL else symbol, start, max(end, start + 1.0 / RATE), stress))
    audio = silence(phones[-1].end, RATE)
    phones[-1] = Phone(phones[-1].symbol, phones[-1].start, audio.duration, phones[-1].stress)
    utterance = Utterance("", "en-us", audio, tuple(phones), ())
    others = [name for name in CHANNELS if name not in ("lips", "manual")]
    score = compose(ChannelInputs(audio.duration, utterance, lively=False), without=others)
    return machine().mouth(blend.at(score, np.arange(0.0, seconds, 1.0 / FPS), load_lip_rig()))[:, 0]


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sentences", type=int, default=16)
    options = parser.parse_args()
    every = list(sentences(options.folder))
    chosen = every[:: max(len(every) // options.sentences, 1)][: options.sentences]
    draw = np.random.default_rng(0)
    found: dict[str, list[float]] = {"boundaries moved by up to ±20 ms": [], "our own alignment": []}
    for sentence in chosen:
        seconds = sentence.labels[-1].end - 1.0 / FPS
        aligned = align(read_recording(sentence.sound), sentence.text)
        ours = [Label(p.symbol, p.start, p.end) for p in aligned.phones]
        by_hand = gap(sentence.labels, seconds)
        for name, labels in zip(found, (moved(sentence.labels, draw), ours), strict=True):
            found[name].append(float(np.corrcoef(by_hand, gap(labels, seconds))[0, 1]))
    for name, values in found.items():
        tenth, half = np.percentile(values, (10.0, 50.0))
        reached = sum(value >= ASKED for value in values)
        print(
            f"{name}: lip gap r mean {np.mean(values):.3f}, median {half:.3f}, 10th percentile {tenth:.3f}, "
            f"least {min(values):.3f}; {ASKED} or more in {reached} of {len(values)} sentences"
        )


if __name__ == "__main__":
    main()
