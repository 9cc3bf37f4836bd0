"""What a user may choose, with its defaults."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from fractions import Fraction
from pathlib import Path
from typing import Any

from .core.look import Look
from .core.performance import parse_fps
from .core.score import BlendSettings
from .errors import InputError, unknown

LARGEST_SIDE = 4096
# The policy that keeps most of a display without on/off flutter or spoilt rounding: docs/combination.md.
PLANNED = BlendSettings(conflict="graded")
"""How the movements of a planned score are combined."""
DYNAMICS = ("springs", "biphasic", "static")


@dataclass(frozen=True, slots=True)
class BlendChoices:
    """How movements are combined, as far as a user chooses: None leaves it to the score that is performed,
    or to `PLANNED` for one that is planned. The fields are those of `BlendSettings`.
    """

    conflict: str | None = None
    activation_threshold: float | None = None
    min_onset: float | None = None
    min_offset: float | None = None
    onset_function: str | None = None
    contact: bool | None = None
    lips: str | None = None

    def over(self, settings: BlendSettings) -> BlendSettings:
        """Return `settings` with the choices in place of theirs."""
        chosen: dict[str, Any] = {f.name: getattr(self, f.name) for f in fields(self)}
        return replace(settings, **{name: value for name, value in chosen.items() if value is not None})


@dataclass(frozen=True, slots=True)
class Settings:
    """All settings of a performance; frozen, checked on creation (InputError names the one at fault).

    `language` (BCP 47) chooses its first voice where `voice` is None. `voice_emotion`: whether emotions
    change a synthesized voice. `lead`, `tail`: seconds of silence around plain text. `articulation`: factor
    on how far the lips move, 0 to 2 (hypo- below, hyper-articulation above 1); `manner` of speech: "plain",
    "whisper", "murmur" or "shout". `at`: second of the frame that a `.png` shows (the middle where None);
    `every`: a `.png` is a sheet of every n-th frame instead. `lively`: rules, random blinks, head and eye
    movements. `profile`: who speaks, a name or a `.toml` file; `attitudes` lie over it. `rules`: a file of
    rules that adds to ours, replaces or deletes them. `dynamics` of the skin: "springs" (with inertia),
    "biphasic" (springs that stiffen under strain), "static" (no inertia). `age`: years, 0 to 100, the head's
    own where None; `shape`: the head's sliders, -1 to 1 by name; `wrinkles`: factors 0 to 2 by region of the
    face, for a speaker who shows some more or less than others of that age. `look`: how all this is drawn;
    `blend`: how movements are combined.
    """

    fps: Fraction = Fraction(30)
    size: tuple[int, int] = (720, 720)
    seed: int = 0
    head: str = "standard"
    age: float | None = None
    shape: Mapping[str, float] = field(default_factory=dict)
    wrinkles: Mapping[str, float] = field(default_factory=dict)
    voice: str | None = None
    language: str | None = None
    rate: int | None = None
    voice_emotion: bool = True
    lead: float = 0.5
    tail: float = 0.7
    articulation: float = 1.0
    manner: str = "plain"
    lively: bool = True
    dynamics: str = "springs"
    without: tuple[str, ...] = ()
    profile: str = "neutral"
    attitudes: tuple[str, ...] = ()
    rules: Path | None = None
    at: float | None = None
    every: int | None = None
    look: Look = field(default_factory=Look)
    blend: BlendChoices = field(default_factory=BlendChoices)

    def __post_init__(self) -> None:
        parse_fps(self.fps)
        if self.dynamics not in DYNAMICS:
            raise InputError(unknown("dynamics", str(self.dynamics), DYNAMICS))
        for what, value, low, high in (
            ("lead", self.lead, 0.0, 60.0),
            ("tail", self.tail, 0.0, 60.0),
            ("articulation", self.articulation, 0.0, 2.0),
            ("age", self.age if self.age is not None else 0.0, 0.0, 100.0),
            ("at", self.at if self.at is not None else 0.0, 0.0, math.inf),
            ("every", self.every if self.every is not None else 1, 1, 1_000_000),
            ("seed", self.seed, 0, 2**63 - 1),
            *((f"size {side}", side, 16, LARGEST_SIDE) for side in self.size),
        ):
            if not low <= value <= high:
                raise InputError(f"{what} = {value} is out of range; expected {low:g} to {high:g}")


def parse_size(text: str) -> tuple[int, int]:
    """Return width and height of a text such as "720x720"; raise InputError if it is none."""
    match = re.fullmatch(r"(\d{1,5})[xX×](\d{1,5})", text.strip())
    if match is None:
        raise InputError(f"size '{text}' is not a size; expected e.g. 720x720")
    return int(match[1]), int(match[2])
