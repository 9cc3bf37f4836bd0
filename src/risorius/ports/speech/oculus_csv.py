"""`.oculus.csv`: weights of the 15 visemes of OVRLipSync (Meta), one row per frame; they add up to 1.

Neighbours fade into each other over `FADE` seconds about their common edge. Lost: all but the phones.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...core.arrays import Array
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import table_lines, write_lines
from .visemes import OCULUS, Cue, Viseme, cues, said

FADE = 0.08
COLUMNS = ("time_s", *OCULUS)


def write_oculus_csv(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the time in seconds and 15 weights; raise OutputError if nothing is said."""
    viseme_cues = cues(said(take), _names, OCULUS[0])
    write_lines(
        path, table_lines(COLUMNS, _rows(viseme_cues, take.performance.times), [6] + [4] * len(OCULUS))
    )


def _names(viseme: Viseme) -> tuple[str, ...]:
    return viseme.oculus


def _rows(viseme_cues: list[Cue], times: Array) -> Iterator[Array]:
    edges = np.array([cue.start for cue in viseme_cues[1:]])
    names = np.array([OCULUS.index(cue.shape) for cue in viseme_cues])
    for time in times:
        # How far each edge has been passed; differences are the shares of the cues between them.
        passed = np.clip((time - edges) / FADE + 0.5, 0.0, 1.0)
        shares = np.concatenate([[1.0], passed]) - np.concatenate([passed, [0.0]])
        weights = np.zeros(len(OCULUS))
        np.add.at(weights, names, np.maximum(shares, 0.0))
        yield np.concatenate([[time], weights])


register(
    ".oculus.csv", "weights of the 15 visemes of OVRLipSync", {"speech"}, write_oculus_csv, reads=("fps",)
)
