"""A take as a piece of HTML: a picture, the sound to play, and the curves with the words below them."""

from __future__ import annotations

import base64
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from ..core.arrays import Array
from .shown_take import ShownTake, liveliest

_WIDE, _HIGH, _FOOT = 640, 180, 46
_LONGEST_SOUND = 120.0  # s; a page holds 44 kB a second
_MOST_POINTS = 600
_NAMES = f"font:12px sans-serif;width:{_WIDE}px;display:flex;flex-wrap:wrap"
_COLOURS = ("#0b8c82", "#d1495b", "#5b6fb5", "#c98a2c", "#7a5ca0", "#469654", "#a0604c", "#608094")


def html(take: ShownTake, png: bytes) -> str:
    """Return the page; `png` is a picture of the take."""
    parts = [
        f'<img alt="the face" width="320" style="vertical-align:top" src="{_data(png, "image/png")}">',
        f'<div style="display:inline-block">{_curves(take)}{_sound(take)}</div>',
    ]
    return f'<div class="risorius">{"".join(parts)}</div>'


def _data(content: bytes, kind: str) -> str:
    return f"data:{kind};base64,{base64.b64encode(content).decode()}"


def _sound(take: ShownTake) -> str:
    if take.audio is None:
        return ""
    if take.audio.duration > _LONGEST_SOUND:
        return f"<p>The sound, {take.audio.duration:.0f} s, is too long for a page.</p>"
    content = _data(Path(take.audio.path).read_bytes(), "audio/wav")
    return f'<audio controls style="width:{_WIDE}px" src="{content}"></audio>'


def _curves(take: ShownTake) -> str:
    """Return a drawing of the curves that move most, their names, and the words under them."""
    curves, seconds = liveliest(take.performance), max(take.performance.duration, 1e-3)
    lines = [
        f'<polyline fill="none" stroke="{colour}" stroke-width="1.5" points="{_points(curve)}">'
        f"<title>{name}</title></polyline>"
        for (name, curve), colour in zip(curves.items(), _COLOURS, strict=False)
    ]
    said = take.utterance.words if take.utterance else ()
    words = [
        f'<text x="{_WIDE * word.start / seconds:.1f}" y="{_HIGH + 14 + 14 * (k % 2)}">'
        f"{escape(word.text)}</text>"
        for k, word in enumerate(said)
    ]
    names = [
        f'<span style="color:{colour};margin-right:1em">{name}</span>'
        for name, colour in zip(curves, _COLOURS, strict=False)
    ]
    drawing = (
        f'<svg width="{_WIDE}" height="{_HIGH + _FOOT}" viewBox="0 0 {_WIDE} {_HIGH + _FOOT}"'
        f' font-size="12" font-family="sans-serif" fill="currentColor">{"".join(lines)}{"".join(words)}</svg>'
    )
    return f'{drawing}<div style="{_NAMES}">{"".join(names)}</div>'


def _points(curve: Array) -> str:
    """Return a curve as points of the drawing; of a long one the largest values of equal parts."""
    parts: list[Any] = np.array_split(curve, min(len(curve), _MOST_POINTS))
    high = np.array([part.max() for part in parts])
    across = np.linspace(0.0, _WIDE, len(high))
    down = (1.0 - np.clip(high, 0.0, 1.0)) * (_HIGH - 2) + 1
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(across, down, strict=True))
