"""Prosody from the sound: pitch, loudness, prominent syllables, accents and boundaries with their tones."""

from .measure import measured, speech_rate

__all__ = ["measured", "speech_rate"]
