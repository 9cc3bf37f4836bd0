"""The sound device, if there is one."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ...errors import OutputError


def open_output(rate: int, callback: Callable[..., None] | None = None) -> Any:
    """Return sounddevice's stream of one 16-bit channel at `rate` Hz, which is not started.

    Raises OutputError if sounddevice (the extra `stream`), or an output device, is missing.
    """
    try:
        import sounddevice
    except (ImportError, OSError) as error:
        message = f"sound needs sounddevice and PortAudio ({error}); expected --without-sound"
        raise OutputError(message) from None
    try:
        return sounddevice.OutputStream(samplerate=rate, channels=1, dtype="int16", callback=callback)
    except sounddevice.PortAudioError as error:
        raise OutputError(f"no sound can be played ({error}); expected --without-sound") from None
