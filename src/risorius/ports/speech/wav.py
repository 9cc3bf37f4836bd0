"""`.wav`: the voice."""

from __future__ import annotations

import wave
from pathlib import Path

from ...core.speech.audio import Audio
from ...errors import OutputError
from ..export_source import WritableTake, WriteOptions
from ..formats import register


def write_wav(take: WritableTake, path: Path, _options: WriteOptions) -> None:
    """Write the sound as 16-bit mono PCM. Raises OutputError if nothing is said."""
    audio = voice_of(take)
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(audio.sample_rate)
        for block in audio.blocks():
            file.writeframes(block.astype("<i2", copy=False).tobytes())


def voice_of(take: WritableTake) -> Audio:
    """Return the sound of a take; raise OutputError if it has none."""
    if take.audio is None:
        raise OutputError("there is no voice to write; expected a performance that speaks")
    return take.audio


register(".wav", "the voice", {"speech"}, write_wav, order=5)
