"""A client's settings as the library's; nothing that a client names is ever opened as a file."""

from __future__ import annotations

from collections.abc import Mapping

from ...core.frame_rate import parse_fps
from ...errors import InputError, unknown
from ...face.head.head import shipped_heads
from ...rules.profiles import profile
from ...settings import Settings, settings_of
from ...speech.engines.registry import is_voice_file
from .messages import StartFace

NAMES = (
    "language", "voice", "rate", "voice_emotion", "format", "keep_tags", "profile", "attitudes", "blinks",
    "lively", "manner", "articulation", "without", "head", "age", "shape", "dynamics", "seed",
)  # fmt: skip
"""The settings that a client may choose."""
FASTEST = 120
"""Frames a second that a client may ask for."""


def settings_from(start: StartFace) -> Settings:
    """Return the settings that a client asks for; raises InputError or ParameterError for an invalid one."""
    _check(start.settings)
    fps = parse_fps(start.fps)
    if not 1 <= fps <= FASTEST:
        raise InputError(f"{float(fps):g} frames a second; expected 1 to {FASTEST}")
    values = {name: tuple(v) if isinstance(v, list) else v for name, v in start.settings.items()}
    return settings_of({**values, "fps": fps})


def _check(values: Mapping[str, object]) -> None:
    other = next((name for name in values if name not in NAMES), None)
    if other is not None:
        raise InputError(unknown("setting", other[:40], NAMES))
    head, voice, speaker = (values.get(name) for name in ("head", "voice", "profile"))
    if isinstance(head, str) and head not in shipped_heads():
        raise InputError(unknown("head", head[:40], shipped_heads()))
    if isinstance(voice, str) and is_voice_file(voice):
        raise InputError(f"voice '{voice[:40]}' is a file; expected the name of a voice")
    if isinstance(speaker, str):
        profile(speaker)
