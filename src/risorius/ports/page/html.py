"""`.html`: a page that plays the performance by itself. Lost: the curves between frames.

The page holds the head, its faces, sound, captions and explanations, and the modules that the studio shows
them with. It fetches nothing: its own policy forbids that.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from dataclasses import asdict
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from ...browser import ROOT
from ...core.channels import CHANNELS
from ...core.score import Score
from ..export_source import WritableTake, WriteOptions
from ..formats import register
from ..speech.subtitles import subtitles
from ..table import write_lines
from .face_packer import FacePacker
from .head_glb import head_glb
from .head_shade import shade
from .page_faces import CHUNK, STEP, PackedFaces, deflated
from .page_modules import import_map, name_of
from .skin_formulas import skin_tables

ENTRY = "player/played.js"
EXPLAINED_EVERY = 0.1
"""Seconds between the times that are explained."""
_TITLE_LENGTH = 80
_FLOAT = 4  # bytes


def write_html(take: WritableTake, path: Path, options: WriteOptions) -> None:
    """Write the page."""
    packer = FacePacker(take.shown_head)
    faces = PackedFaces(packer, take.faces(progress=options.progress))
    stage = asdict(packer.described()) | {"step": STEP}
    facts = {"stage": stage, "chunk": CHUNK, **_facts(take)}
    data = {
        "facts": deflated(json.dumps(facts).encode()),
        "head": deflated(_planes(head_glb(packer))),
        "shade": deflated(shade(packer.head)),
        "folds": deflated(packer.folds.places()),
        "skin": deflated(skin_tables()),
        "poses": deflated(faces.poses),
        **{f"faces-{n}": chunk for n, chunk in enumerate(faces.chunks)},
    }
    if take.audio is not None:
        data["sound"] = take.audio.path.read_bytes()
    text = take.utterance.text if take.utterance else ""
    write_lines(path, [_page(" ".join(text.split()), data)])


def _page(title: str, data: dict[str, bytes]) -> str:
    styles = "".join((ROOT / name).read_text("utf-8") for name in ("style/tokens.css", "player/played.css"))
    named = escape(title if len(title) <= _TITLE_LENGTH else f"{title[:_TITLE_LENGTH]} …")
    blocks = "\n".join(
        f'<script type="text/plain" id="data-{name}">{base64.b64encode(content).decode()}</script>'
        for name, content in data.items()
    )
    parts = {
        "icon": base64.b64encode((ROOT / "icon.svg").read_bytes()).decode(),
        "title": named or "A performance",
        "style": styles,
        "imports": import_map(ENTRY),
        "entry": name_of(ENTRY),
        "data": blocks,
    }
    page = (ROOT / "player/played.html").read_text("utf-8")
    head, *fields = page.split("{{")
    filled = (part.partition("}}") for part in fields)
    return head + "".join(parts[name] + after for name, _, after in filled)


def _facts(take: WritableTake) -> dict[str, Any]:
    performance = take.performance
    cues = subtitles(take.utterance) if take.utterance else ()
    words = take.utterance.words if take.utterance else ()
    return {
        "duration": performance.duration,
        "fps": str(performance.fps),
        "frames": len(performance.values),
        "words": [[word.text, word.start, word.end] for word in words],
        "captions": [[cue.shape, cue.start, cue.end] for cue in cues],
        "lanes": list(_lanes(performance.score)),
        "every": EXPLAINED_EVERY,
        "reasons": _reasons(take),
    }


def _lanes(score: Score) -> Iterator[dict[str, Any]]:
    """Yield the channels with their movements: label, start, end and moved parameters."""
    for channel in CHANNELS:
        blocks = [
            [m.cause.trigger or m.label, m.start, m.end, m.cause.rule, dict(m.parameters)]
            for m in score.movements
            if m.channel == channel
        ]
        if channel == "lips":
            blocks += [
                [s.phone, s.start, s.end, s.cause.rule, dict(s.targets)] for s in score.lips if s.phone
            ]
        if blocks:
            yield {"channel": channel, "blocks": blocks}


def _reasons(take: WritableTake) -> dict[str, Any]:
    """Return the lines that explain each time, every line once."""
    numbers: dict[str, int] = {}
    duration = take.performance.duration
    times = np.arange(0.0, duration, EXPLAINED_EVERY).tolist()
    rows = [[numbers.setdefault(line, len(numbers)) for line in take.reasons(time)] for time in times]
    return {"lines": list(numbers), "times": rows}


def _planes(data: bytes) -> bytes:
    """Return the first bytes of all float32, then the second, and so on: so they deflate to less."""
    padded = np.frombuffer(data.ljust(-(-len(data) // _FLOAT) * _FLOAT, b"\0"), np.uint8)
    return padded.reshape(-1, _FLOAT).T.tobytes()


register(".html", "a page that plays the performance", {"head"}, write_html, reads=("hair", "complexion"))
