"""`.feedback.xml`: the plan as BML 1.0 feedback: when each behaviour will start and end (predictionFeedback).

Behaviours are the words, the marks of the script, and the movements of all channels but the lips. Times in
seconds. Lost: targets and curves; progress feedback belongs to a running agent and is not predicted.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from xml.sax.saxutils import quoteattr

from ...core.movement import Movement
from ...script.bml_shapes import NAMESPACE, PEAKS
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..table import write_lines

_BLOCK = "risorius"


def write_bml_feedback(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write one block with its predicted times."""
    write_lines(path, _lines(take))


def _lines(take: WritableTake) -> Iterator[str]:
    end = f"{take.performance.duration:.6f}"
    yield '<?xml version="1.0" encoding="utf-8"?>'
    yield f'<predictionFeedback xmlns="{NAMESPACE}">'
    yield f'  <bml id="{_BLOCK}" globalStart="0" globalEnd="{end}"/>'
    if take.utterance is not None:
        yield f'  <speech id="{_BLOCK}:speech" start="0" end="{end}">'
        for number, word in enumerate(take.utterance.words):
            yield f'    <sync id="word{number}" time="{word.start:.6f}"/>'
        for mark in take.utterance.marks:
            yield f'    <sync id={quoteattr(mark.name)} time="{mark.time:.6f}"/>'
        yield "  </speech>"
    for number, movement in enumerate(take.performance.score.movements):
        element = _behaviour(movement)
        name = quoteattr(f"{_BLOCK}:{movement.id or f'{movement.channel}{number}'}")
        peak = min(movement.start + movement.onset, movement.end)
        relax = max(movement.end - movement.offset, peak)
        yield (
            f'  <{element} id={name} start="{movement.start:.6f}" {PEAKS[element]}="{peak:.6f}" '
            f'relax="{relax:.6f}" end="{movement.end:.6f}"/>'
        )
    yield "</predictionFeedback>"


def _behaviour(movement: Movement) -> str:
    """Return a movement's BML element: gaze, which may turn the head; head, which the eyes may counter."""
    moved = {name.partition("_")[0] for name in movement.targets}
    if not moved <= {"head", "gaze"}:
        return "face"
    return "head" if "head" in moved and movement.channel != "gaze" else "gaze"


register(".feedback.xml", "the plan as BML feedback", {"movements"}, write_bml_feedback)
