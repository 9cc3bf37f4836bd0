"""`.performance.json`: the curves with the score that they were made from."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..core.arrays import Array
from ..core.frame_rate import parse_fps
from ..core.parameters import NAMES, PARAMETERS, Parameter
from ..core.performance import Performance, frame_count
from ..errors import unknown
from .formats import register
from .layout import write_json
from .node import Node
from .readable import PerformanceFile, ReadOptions
from .score_json import VERSION, check_version, reading, score_from_json, score_to_json
from .writable import WritableTake, WriteOptions

_KEYS = ("risorius", "fps", "curves", "score")
# Curves that were added up may miss their limits by rounding.
_SLACK = 1e-6


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


def read_performance(path: Path) -> Performance:
    """Return the performance in a file, equal to the one that was written; speech is not looked at.

    Raises InputError or ParameterError, with the file and the path in it, as `score_json.read_score`, and
    if a curve is missing, of another length or out of range.
    """
    return reading(path, lambda node: _performance(node, path.parent, speech=False)).performance


def read_performance_file(path: Path) -> PerformanceFile:
    """Return the performance in a file and what is said in it. Raises as `read_performance`."""
    return reading(path, lambda node: _performance(node, path.parent, speech=True))


def read_performance_json(path: Path, _options: ReadOptions) -> PerformanceFile:
    """Return what `read_performance_file` does: the table of formats calls this."""
    return read_performance_file(path)


def _performance(node: Node, folder: Path, *, speech: bool) -> PerformanceFile:
    entries = node.entries(_KEYS, _KEYS)
    check_version(entries["risorius"])
    rate = _rate(entries["fps"])
    with entries["fps"].located():
        fps = parse_fps(rate)
    held = score_from_json(entries["score"], folder, speech=speech)
    values = _curves(entries["curves"], frame_count(held.score.duration, fps))
    return PerformanceFile(Performance(held.score, fps, values), held.utterance)


def _rate(node: Node) -> str | float:
    return node.text() if isinstance(node.value, str) else node.number()


def _curves(node: Node, count: int) -> Array:
    curves = node.members()
    for name, curve in curves.items():
        if name not in NAMES:
            raise curve.fault(unknown("parameter", name, NAMES))
    missing = [name for name in NAMES if name not in curves]
    if missing:
        raise node.fault(f"the curve of {missing[0]} is missing")
    values = np.empty((count, len(NAMES)))
    for column, parameter in enumerate(PARAMETERS):
        values[:, column] = [_value(item, parameter) for item in curves[parameter.name].items(count)]
    return values


def _value(node: Node, parameter: Parameter) -> float:
    number = node.number()
    if not parameter.low - _SLACK <= number <= parameter.high + _SLACK:
        raise node.fault(f"{number:g} is out of range; expected {parameter.low:g} to {parameter.high:g}")
    return number


register(
    ".performance.json",
    "curves with their score",
    {"curves"},
    write_performance_json,
    read_performance_json,
    order=10,
)
