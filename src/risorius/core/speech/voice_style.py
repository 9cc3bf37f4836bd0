"""Changes of a stretch of speech from the usual manner of its voice."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class VoiceAdjustment:
    """Changes of a voice: factors of rate, range of pitch and pauses, semitones of pitch, dB of loudness."""

    rate: float = 1.0
    pitch: float = 0.0
    range: float = 1.0
    volume: float = 0.0
    pauses: float = 1.0

    def then(self, other: VoiceAdjustment) -> VoiceAdjustment:
        """Return both changes as one; the order does not matter."""
        return VoiceAdjustment(
            self.rate * other.rate,
            self.pitch + other.pitch,
            self.range * other.range,
            self.volume + other.volume,
            self.pauses * other.pauses,
        )


PLAIN = VoiceAdjustment()
