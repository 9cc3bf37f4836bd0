"""How well and how fast recordings are aligned, against labels by hand.

Run from the repository's root: `.venv/bin/python benchmarks/align.py FOLDER`, FOLDER in TIMIT's layout (see
`timit.py` for how its labels map to our phones). A phone that only one side has is counted, and left out of
the times. Target: at least 80 % of phone starts within 20 ms of the labels, no failed file, 10x real time.
`tools/fit_edges.py FOLDER` prints the figures for speakers from whom nothing was learned.
"""

from __future__ import annotations

import collections
import sys
import time
import warnings
from pathlib import Path

import numpy as np
from timit import Label, matched, sentences

from risorius.errors import RisoriusError
from risorius.languages import phonesets
from risorius.speech.alignment import align
from risorius.speech.recordings.recording import read_recording

KINDS = {
    "affricate": ("CH", "JH"),
    "stop": ("P", "T", "K", "B", "D", "G"),
    "nasal": ("M", "N", "NG"),
    "fricative": ("S", "Z", "SH", "ZH", "F", "TH", "V", "DH", "HH"),
    "approximant": ("L", "R", "W", "Y"),
    "silence": ("",),
}
LIMIT = 0.02
FEWEST = 5


def kind(symbol: str) -> str:
    if phonesets.is_vowel(symbol):
        return "vowel"
    return next(name for name, phones in KINDS.items() if symbol in phones)


def report(name: str, errors: list[float]) -> None:
    away = 1000 * np.abs(errors)
    within = "  ".join(f"{100 * (away <= ms).mean():5.1f}" for ms in (10, 20, 30, 50))
    bias = 1000 * np.median(errors)
    print(f"{name:26s} {len(errors):5d}   {within}   {np.median(away):5.1f}   {bias:+5.1f}")


def main(folder: Path) -> None:
    by_pair: dict[str, list[float]] = collections.defaultdict(list)
    starts: list[float] = []
    failed, only_ours, only_labelled, seconds, spent = 0, 0, 0, 0.0, 0.0
    for sentence in sentences(folder):
        audio = read_recording(sentence.sound)
        before = time.process_time()
        try:
            utterance = align(audio, sentence.text)
        except RisoriusError as error:
            failed += 1
            print(f"failed: {sentence.sound}: {error}")
            continue
        spent += time.process_time() - before
        seconds += audio.duration
        ours = [Label(p.symbol, p.start, p.end) for p in utterance.phones]
        pairs = [(i, j) for i, j in matched(ours, sentence.labels) if i and ours[i].symbol]
        pairs = [(i, j) for i, j in pairs if sentence.labels[j].symbol not in ("", "q")]
        only_ours += sum(bool(phone.symbol) for phone in ours) - len(pairs)
        only_labelled += sum(label.symbol not in ("", "q") for label in sentence.labels) - len(pairs)
        for i, j in pairs:
            error = ours[i].start - sentence.labels[j].start
            starts.append(error)
            by_pair[f"{kind(ours[i - 1].symbol)} {kind(ours[i].symbol)}"].append(error)
    print(f"{'phone starts':26s} {'count':>5s}   % in 10 ms 20 ms 30 ms 50 ms  median  bias ms")
    for name in sorted(by_pair, key=lambda name: -len(by_pair[name])):
        if len(by_pair[name]) >= FEWEST:
            report(name, by_pair[name])
    report("all", starts)
    print(f"{failed} files failed; phones not labelled: {only_ours}; labels without a phone: {only_labelled}")
    print(f"{seconds / spent:.0f}x real time ({seconds:.0f} s of speech in {spent:.1f} s of one core)")


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        main(Path(sys.argv[1]))
