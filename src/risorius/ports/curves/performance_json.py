"""`.performance.json`: the curves with the score that they were made from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Annotated

import numpy as np

from ...core.arrays import Array
from ...core.frame_rate import parse_fps
from ...core.parameters import NAMES, PARAMETERS
from ...core.performance import Performance, frame_count
from ...errors import InputError, Place, unknown
from ...reading.hints import Numbers, Then
from ...reading.schema import MisfitError, placed, within
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..import_result import PerformanceFile, ReadOptions
from ..layout import write_json
from ..score.score_json import VERSION, FormatVersion, ScoreDocument, load_document, score_to_json

# Curves that were added up may miss their limits by rounding.
_SLACK = 1e-6


@dataclass(frozen=True, slots=True)
class PerformanceDocument:
    """A performance's file, as it is written: curves by parameter, one number a frame."""

    risorius: FormatVersion
    fps: Annotated[Fraction, Then(parse_fps, of=str | float)]
    curves: Mapping[str, Numbers]
    score: ScoreDocument

    def performance_file(self, folder: Path = Path()) -> PerformanceFile:
        """Return the performance and its utterance; its sound is looked for from `folder` on.

        Raises as `ScoreDocument.score_file`, and MisfitError if a curve is missing, of another length or out
        of range.
        """
        with within("score"):
            score_file = self.score.score_file(folder)
        with within("curves"):
            values = self._values(frame_count(score_file.score.duration, self.fps))
        return PerformanceFile(Performance(score_file.score, self.fps, values), score_file.utterance)

    def _values(self, count: int) -> Array:
        for name in self.curves:
            if name not in NAMES:
                raise MisfitError(unknown("parameter", name, NAMES), name)
        for name in NAMES:
            if name not in self.curves:
                raise MisfitError(f"the curve of {name} is missing; expected one for each parameter")
            if len(self.curves[name]) != count:
                raise MisfitError(f"{name} has {len(self.curves[name])} values; expected {count}", name)
        values = np.stack([self.curves[name] for name in NAMES], axis=1)
        _check_ranges(values)
        return values


def _check_ranges(values: Array) -> None:
    low, high = (np.array([getattr(p, end) for p in PARAMETERS]) for end in ("low", "high"))
    wrong = np.argwhere((values < low - _SLACK) | (values > high + _SLACK))
    if len(wrong):
        frame, column = map(int, wrong[0])
        parameter = PARAMETERS[column]
        fault = f"{parameter.name}[{frame}] = {values[frame, column]:g} is out of range"
        message = f"{fault}; expected {parameter.low:g} to {parameter.high:g}"
        raise MisfitError(message, parameter.name, frame)


def write_performance_json(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write a take's curves, exactly, and its score."""
    performance = take.performance
    document = {
        "risorius": VERSION,
        "fps": str(performance.fps),
        "curves": {name: curve.tolist() for name, curve in performance.curves.items()},
        "score": score_to_json(performance.score, take.utterance, options.voice, path.parent),
    }
    write_json(path, document)


def read_performance_file(path: Path) -> PerformanceFile:
    """Return the performance in a file, equal to the one that was written, and its utterance.

    Raises InputError or ParameterError, with the place in the file, as `score_json.read_score_file`, and if a
    curve is missing, of another length or out of range.
    """
    if path.name.lower().endswith(".score.json"):
        expected = f"risorius speak {path.name} -o {path.name[: -len('.score.json')]}.performance.json"
        raise InputError(f"is a score; expected a performance, as of {expected}", Place(str(path)))
    document = load_document(path, "performance")
    performance = document.read(PerformanceDocument)
    with placed(document.source):
        return performance.performance_file(path.parent)


def read_performance_json(path: Path, _options: ReadOptions) -> PerformanceFile:
    """Return the result of `read_performance_file`: the table of formats calls this."""
    return read_performance_file(path)


register(
    ".performance.json",
    "curves with their score",
    {"curves"},
    write_performance_json,
    read_performance_json,
    order=10,
)
