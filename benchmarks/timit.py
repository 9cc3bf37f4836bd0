"""Labelled speech in TIMIT's layout, and how its labels are compared with our phones.

FOLDER/SPEAKER/SENTENCE.wav with .txt (the words), .phn (labels: first sample, last sample, name), in any
case. A closure and the burst after it are one stop, which begins at the closure; a closure without a burst is
a stop too; a stop without a closure begins at its burst. Variants go to the phone that they are a variant of
(flap and glottal stop: dx to T, q to nothing; syllabic el, em, en to L, M, N; ix to IH, ax to AH, axr to ER,
ux to UW, hv to HH, nx to N). h#, pau and epi are silence.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from risorius.languages import phonesets

RATE = 16_000
CLOSURES = {"bcl": "B", "dcl": "D", "gcl": "G", "pcl": "P", "tcl": "T", "kcl": "K"}
FOLDED = {
    "ix": "IH", "ax": "AH", "ax-h": "AH", "axr": "ER", "ux": "UW", "hv": "HH", "nx": "N", "el": "L",
    "en": "N", "em": "M", "eng": "NG", "dx": "T", "h#": "", "pau": "", "epi": "",
}  # fmt: skip
GLOTTAL = "q"
# What it costs to take one phone for another, to leave one out, and per second of distance.
SIMILAR, OTHER, KIND, SILENT, MISSING, PER_SECOND = 0.5, 1.0, 1.8, 3.0, 0.9, 4.0


class Label(NamedTuple):
    """A phone [start, end) in seconds: ARPAbet, "" for silence, "q" for a glottal stop."""

    symbol: str
    start: float
    end: float


class Sentence(NamedTuple):
    """A labelled recording."""

    speaker: str
    sound: Path
    text: str
    labels: tuple[Label, ...]


def sentences(folder: Path) -> Iterator[Sentence]:
    """Yield the sentences under `folder`, in order."""
    for sound in sorted(path for path in folder.rglob("*") if path.suffix.lower() == ".wav"):
        beside = {path.suffix.lower(): path for path in sound.parent.glob(f"{sound.stem}.*")}
        if {".txt", ".phn"} <= beside.keys():
            text = beside[".txt"].read_text().split(None, 2)[2].strip()
            yield Sentence(sound.parent.name, sound, text, tuple(read_labels(beside[".phn"])))


def read_labels(path: Path) -> Iterator[Label]:
    """Yield the labels of a .phn file, closures joined with their bursts."""
    rows = [
        (int(a) / RATE, int(b) / RATE, name) for a, b, name in map(str.split, path.read_text().splitlines())
    ]
    begun: tuple[float, str] | None = None
    for start, end, name in rows:
        symbol = FOLDED.get(name, name if name == GLOTTAL else name.upper())
        if begun is not None:
            closed_from, stop = begun
            begun = None
            if symbol == stop or (stop in "TD" and symbol in ("CH", "JH")):
                yield Label(symbol, closed_from, end)
                continue
            yield Label(stop, closed_from, start)
        if name in CLOSURES:
            begun = start, CLOSURES[name]
        else:
            yield Label(symbol, start, end)


def matched(found: list[Label], labels: tuple[Label, ...]) -> list[tuple[int, int]]:
    """Return which phone goes with which label: the cheapest way to edit one row into the other."""
    rows, columns = len(found), len(labels)
    best = np.zeros((rows + 1, columns + 1))
    best[:, 0], best[0] = MISSING * np.arange(rows + 1), MISSING * np.arange(columns + 1)
    change = np.array([[_cost(a, b) for b in labels] for a in found])
    for i in range(rows):
        for j in range(columns):
            skipped = min(best[i, j + 1], best[i + 1, j]) + MISSING
            best[i + 1, j + 1] = min(best[i, j] + change[i, j], skipped)
    pairs = []
    i, j = rows, columns
    while i and j:
        if best[i, j] == best[i - 1, j - 1] + change[i - 1, j - 1]:
            i, j = i - 1, j - 1
            pairs.append((i, j))
        elif best[i, j] == best[i - 1, j] + MISSING:
            i -= 1
        else:
            j -= 1
    return pairs[::-1]


def _cost(a: Label, b: Label) -> float:
    away = min(1.0, PER_SECOND * abs(a.start - b.start))
    if a.symbol == b.symbol:
        return away
    if "" in (a.symbol, b.symbol) or GLOTTAL in (a.symbol, b.symbol):
        return SILENT + away
    if phonesets.is_vowel(a.symbol) != phonesets.is_vowel(b.symbol):
        return KIND + away
    kinds = (phonesets.is_vowel, phonesets.is_stop, phonesets.is_nasal)
    return away + (SIMILAR if any(kind(a.symbol) and kind(b.symbol) for kind in kinds) else OTHER)
