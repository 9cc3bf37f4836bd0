"""The meanings of SSML's words (`data/ssml.toml`)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Annotated

from ..reading.hints import Range
from .load import load

SpeechFactor = Annotated[float, Range(0.1, 10.0)]


@dataclass(frozen=True, slots=True)
class SsmlTable:
    """Factors of rate and range, semitones of pitch, dB of volume, seconds of breaks."""

    rate: Mapping[str, SpeechFactor]
    pitch: Mapping[str, Annotated[float, Range(-24.0, 24.0)]]
    range: Mapping[str, SpeechFactor]
    volume: Mapping[str, Annotated[float, Range(-60.0, 12.0)]]
    breaks: Mapping[str, Annotated[float, Range(0.0, 10.0)]] = field(metadata={"key": "break"})


@cache
def ssml_table() -> SsmlTable:
    """Return the package's table."""
    return load(SsmlTable, "ssml.toml")
