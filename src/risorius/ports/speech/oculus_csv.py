"""`.oculus.csv`: weights of the 15 visemes of OVRLipSync (Meta), one row per frame; they add up to 1.

Neighbours fade into each other over `FADE` seconds about their common edge. But at /p b m/ `PP` follows our
own lips: it is 1, and all others 0, as long as they are sealed, however short the phone. Lost: all but the
phones.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import table_lines, write_lines
from .visemes import NEAR, OCULUS, Cue, Viseme, cues, said, sealed

FADE = 0.08
COLUMNS = ("time_s", *OCULUS)
FAR = 0.16  # s before and after a bilabial beyond which it seals no lips
_CLOSED = OCULUS.index("PP")


def write_oculus_csv(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the time in seconds and 15 weights; raise OutputError if nothing is said."""
    times, viseme_cues = take.performance.times, cues(said(take), _names, OCULUS[0])
    weights = _faded(viseme_cues, times)
    closed = sealed(take) * _near(viseme_cues, times)
    before = weights[:, _CLOSED]
    after = np.maximum(before, closed)
    weights *= ((1.0 - after) / np.maximum(1.0 - before, 1e-9))[:, None]
    weights[:, _CLOSED] = after
    rows = np.concatenate([times[:, None], weights], axis=1)
    write_lines(path, table_lines(COLUMNS, rows, [6] + [4] * len(OCULUS)))


def _near(viseme_cues: list[Cue], times: Array) -> Array:
    """Return 1 for times (frames,) near a bilabial, 0 far from all: lips are pressed in other places, too."""
    away = np.full(len(times), np.inf)
    for cue in viseme_cues:
        if cue.shape == OCULUS[_CLOSED]:
            away = np.minimum(away, np.maximum(cue.start - times, times - cue.end))
    return np.asarray(np.clip((FAR - away) / (FAR - NEAR), 0.0, 1.0))


def _names(viseme: Viseme) -> tuple[str, ...]:
    return viseme.oculus


def _faded(viseme_cues: list[Cue], times: Array) -> Array:
    """Return the weights (frames, 15) of cues that fade into each other."""
    edges = np.array([cue.start for cue in viseme_cues[1:]])
    names = np.array([OCULUS.index(cue.shape) for cue in viseme_cues])
    weights = np.zeros((len(times), len(OCULUS)))
    for row, time in zip(weights, times, strict=True):
        # How far each edge has been passed; differences are the shares of the cues between them.
        passed = np.clip((time - edges) / FADE + 0.5, 0.0, 1.0)
        shares = np.concatenate([[1.0], passed]) - np.concatenate([passed, [0.0]])
        np.add.at(row, names, np.maximum(shares, 0.0))
    return np.asarray(weights / weights.sum(axis=1, keepdims=True))


register(
    ".oculus.csv",
    "weights of the 15 visemes of OVRLipSync",
    {"speech"},
    write_oculus_csv,
    uses=("curves",),
)
