"""`.visemes.json .tsv .xml .dat`: mouth shapes as Rhubarb Lip Sync 1.14 writes them, for 2D animation.

Nine shapes (A to H, X for silence) that follow one another without a gap, times to 0.01 s; A lasts as long
as our own lips are sealed. Lost: all but which phone is spoken: how far the mouth opens, emotion, brows,
eyes, head.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from xml.sax.saxutils import escape

from ...core.speech.utterance import Utterance
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..layout import write_json
from ..table import write_lines
from .rhubarb_timing import IDLE, paused, tweened
from .visemes import Cue, Viseme, said, shown_cues

CLOSED = "A"


def mouth_cues(take: WritableTake) -> list[Cue]:
    """Return the cues with their pauses and shapes in between, times rounded to 0.01 s.

    One that then has no duration is left out.
    """
    mouth_cues = tweened(paused(shown_cues(take, _shapes, IDLE, CLOSED)))
    rounded = [Cue(round(cue.start, 2), round(cue.end, 2), cue.shape) for cue in mouth_cues]
    return [cue for cue in rounded if cue.start < cue.end]


def write_rhubarb_json(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write `metadata` and `mouthCues`; raises OutputError if nothing is said, as the others here."""
    utterance = said(take)
    rows = [{"start": cue.start, "end": cue.end, "value": cue.shape} for cue in mouth_cues(take)]
    write_json(path, {"metadata": _metadata(utterance, options), "mouthCues": rows})


def write_rhubarb_tsv(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write a start and a shape on each line; the last line is the end, idle."""
    utterance = said(take)
    lines = [f"{cue.start:.2f}\t{cue.shape}" for cue in mouth_cues(take)]
    write_lines(path, [*lines, f"{utterance.duration:.2f}\t{IDLE}"])


def write_rhubarb_xml(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write `rhubarbResult` with its cues."""
    utterance = said(take)
    metadata = _metadata(utterance, options)
    lines = ['<?xml version="1.0" encoding="utf-8"?>', "<rhubarbResult>", "  <metadata>"]
    lines.append(f"    <soundFile>{escape(str(metadata['soundFile']))}</soundFile>")
    lines.append(f"    <duration>{metadata['duration']:.2f}</duration>")
    lines += ["  </metadata>", "  <mouthCues>"]
    for cue in mouth_cues(take):
        lines.append(f'    <mouthCue start="{cue.start:.2f}" end="{cue.end:.2f}">{cue.shape}</mouthCue>')
    write_lines(path, [*lines, "  </mouthCues>", "</rhubarbResult>"])


def write_moho_dat(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write Moho switch data: a frame, counted from 1 at the performance's rate, and a shape on each line."""
    utterance, fps = said(take), take.performance.fps
    lines, last = ["MohoSwitch1"], 0
    for cue in mouth_cues(take):
        if (frame := _frame(cue.start, fps)) != last:
            lines.append(f"{frame} {cue.shape}")
            last = frame
    write_lines(path, [*lines, f"{max(_frame(utterance.duration, fps), last + 1)} {IDLE}"])


def _shapes(viseme: Viseme) -> tuple[str, ...]:
    return viseme.rhubarb


def _metadata(utterance: Utterance, options: WriteOptions) -> dict[str, object]:
    sound = options.voice.name if options.voice is not None else ""
    return {"soundFile": sound, "duration": round(utterance.duration, 2)}


def _frame(seconds: float, fps: Fraction) -> int:
    return 1 + int(seconds * fps)


register(
    ".visemes.json",
    "mouth shapes as Rhubarb Lip Sync writes them",
    {"speech"},
    write_rhubarb_json,
    uses=("curves",),
)
register(".visemes.tsv", "the same as a table", {"speech"}, write_rhubarb_tsv, uses=("curves",))
register(".visemes.xml", "the same as XML", {"speech"}, write_rhubarb_xml, uses=("curves",))
register(".visemes.dat", "the same as Moho switch data", {"speech"}, write_moho_dat, uses=("curves",))
