"""The speech engines by name, and voices that are files, by suffix.

Importing the package registers every engine (`engines/__init__.py`); this module knows none of them.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from ...core.registry import Registry
from ...errors import SpeechError
from ...machine.paths import is_file
from .protocol import SpeechEngine

# Engines by name; each entry makes (or returns) the engine.
ENGINES: Registry[Callable[[], SpeechEngine]] = Registry("speech engine")
DEFAULT_ENGINE = "espeak"
# Voices that are files, by suffix: what makes the engine from the file and a language (BCP 47, None: its
# own).
VOICE_FILES: Registry[Callable[[Path, str | None], SpeechEngine]] = Registry("voice file")


def load_engine(name: str = DEFAULT_ENGINE) -> SpeechEngine:
    """Return the speech engine called `name`; raise ParameterError if it is unknown."""
    return ENGINES.get(name)()


def is_voice_file(name: str | None) -> bool:
    """Tell whether a voice is named by its file: there is one, or the name can be nothing else."""
    if not name or "\0" in name:
        return False
    path = Path(name)
    return path.is_absolute() or name[0] == "." or path.suffix.lower() in (".onnx", ".py") or is_file(path)


def load_voice_file(name: str, language: str | None = None) -> SpeechEngine:
    """Return the engine of a voice file; raise SpeechError if it does not exist or is not a voice."""
    path = Path(name)
    if not is_file(path):
        raise SpeechError(f"there is no voice '{name}'; expected a program or a Piper model (.onnx)")
    suffix = path.suffix.lower()
    return VOICE_FILES.get(suffix if suffix in VOICE_FILES else "")(path, language)
