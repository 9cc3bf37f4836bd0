"""Changes of the voice by emotions (`data/voice_emotion.toml`; paper B, section 2.2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated

from ..core.speech.voice_style import PLAIN, VoiceAdjustment
from ..reading.hints import Range
from .emotions import emotion
from .load import load

VoiceFactor = Annotated[float, Range(0.3, 3.0)]


@dataclass(frozen=True, slots=True)
class VoiceChange:
    """The changes at full intensity: factors, semitones, dB."""

    rate: VoiceFactor
    pitch: Annotated[float, Range(-12.0, 12.0)]
    range: VoiceFactor
    volume: Annotated[float, Range(-20.0, 12.0)]
    pauses: VoiceFactor

    def manner(self, intensity: float) -> VoiceAdjustment:
        """Return the changes at `intensity` 0..1; each is linear in it."""
        rate, span, pauses = (1.0 + intensity * (full - 1.0) for full in (self.rate, self.range, self.pauses))
        return VoiceAdjustment(rate, intensity * self.pitch, span, intensity * self.volume, pauses)


@dataclass(frozen=True, slots=True)
class VoiceEmotions:
    """The table: one row per basic emotion; others leave the voice as it is."""

    anger: VoiceChange
    disgust: VoiceChange
    fear: VoiceChange
    happiness: VoiceChange
    sadness: VoiceChange
    surprise: VoiceChange


def voice_manner(intensities: Mapping[str, float]) -> VoiceAdjustment:
    """Return the manner of a voice under emotions by name or alias, each with its intensity 0..1.

    Of several, each counts by its share if their intensities add up to more than 1. Raises ParameterError
    for an unknown emotion.
    """
    scale = 1.0 / max(1.0, sum(intensities.values()))
    manner = PLAIN
    for name, intensity in intensities.items():
        change: VoiceChange | None = getattr(_table(), emotion(name).name, None)
        if change is not None:
            manner = manner.then(change.manner(intensity * scale))
    return manner


@cache
def _table() -> VoiceEmotions:
    return load(VoiceEmotions, "voice_emotion.toml")
