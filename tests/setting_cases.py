"""Settings that are not the default, for the laws of settings and options."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import risorius
from risorius.settings import Settings

CASES: dict[str, object] = {
    "language": "de",
    "voice": "en-gb",
    "rate": 120,
    "voice_emotion": False,
    "answers": "Who is it?",
    "lead": 0.25,
    "tail": 0.25,
    "profile": "lively",
    "attitudes": ("ironic",),
    "expression": "posed",
    "blinks": "none",
    "lively": False,
    "manner": "whisper",
    "articulation": 0.5,
    "without": ("lips",),
    "rules": Path("mine.toml"),
    "head": "mei",
    "age": 70.0,
    "shape": {"nose_width": 1.0},
    "muscles": "lines",
    "wrinkles": {"nasolabial": 2.0},
    "dynamics": "biphasic",
    "seed": 4,
    "fps": Fraction(24),
    "size": (48, 32),
    "at": 0.0,
    "every": 2,
    "names": "arkit",
    "style": "wireframe",
    "camera": "eyes",
    "lens": 135.0,
    "light": "dark",
    "background": "red",
    "quality": "high",
    "hair": "short",
    "complexion": 1.0,
    "overlay": ("bars",),
    "conflict": "sum",
    "activation_threshold": 0.9,
    "min_onset": 1.0,
    "min_offset": 1.0,
    "onset_function": "linear",
    "contact": False,
    "lips": "lookahead",
    "rounding": 0.1,
}
"""A value that is not the default for every setting."""
CLAY = risorius.Look(style="clay", quality="draft", hair="bald")
BASE = Settings(size=(32, 32), dynamics="static", look=CLAY)
SKIN = replace(BASE, look=replace(CLAY, style="realistic"))
"""Settings that cost little; clay has no complexion."""
