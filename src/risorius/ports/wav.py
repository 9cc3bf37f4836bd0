"""`.wav`: the voice."""

from __future__ import annotations

import wave
from pathlib import Path

from ..core.audio import Audio
from ..errors import OutputError
from .source import Material, WriteOptions


def write_wav(material: Material, path: Path, _options: WriteOptions) -> None:
    """Write the sound as 16-bit mono PCM. Raises OutputError if nothing is said."""
    audio = voice_of(material)
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(audio.sample_rate)
        for block in audio.blocks():
            file.writeframes(block.astype("<i2", copy=False).tobytes())


def voice_of(material: Material) -> Audio:
    """Return the sound of a material; raise OutputError if it has none."""
    if material.audio is None:
        raise OutputError("there is no voice to write; expected a performance that speaks")
    return material.audio
