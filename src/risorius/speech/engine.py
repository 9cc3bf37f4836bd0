"""What a speech engine is: something that turns a stretch of text into sound with timed phones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Protocol

from ..core.audio import Samples
from ..core.manner import PLAIN, Manner
from ..errors import RisoriusWarning, SpeechError
from ..registry import Registry
from ..script.directions import Break, Span


class SpeechWarning(RisoriusWarning):
    """Something was spoken, but not known exactly."""


@dataclass(frozen=True, slots=True)
class Voice:
    """A voice: the name by which users choose it, its languages (BCP 47, lower case), gender, description.

    The first language is its own, the others are wider ones. `gender` is "male", "female" or "" where
    unknown. `key` is what the engine calls it.
    """

    name: str
    languages: tuple[str, ...]
    gender: str
    description: str
    key: str

    @property
    def language(self) -> str:
        """The language of the voice; "" for what is only a variant of others."""
        return self.languages[0] if self.languages else ""


@dataclass(frozen=True, slots=True)
class SpeechRequest:
    """A stretch of text for an engine to speak in one breath, without line breaks.

    `rate` in words per minute and `pitch` 0..99, None for the voice's own. `end_pause` asks for the pause
    that follows a sentence inside a text. `manner` changes the whole, `directions` parts of it, by characters
    of the text; an engine leaves out what it cannot do. The pauses of `manner` are made for it.
    """

    text: str
    voice: Voice
    rate: int | None = None
    pitch: int | None = None
    end_pause: bool = False
    manner: Manner = PLAIN
    directions: tuple[Span | Break, ...] = ()


class SpokenPhone(NamedTuple):
    """A phone that starts at sample `start` and lasts to the start of the next one.

    `symbol` is ARPAbet for English, IPA for other languages, "" for silence. `stress` as in core's Phone.
    `closure`: by how many samples the articulators close before `start`, as far as the engine knows.
    `position`: index in the text of the word it belongs to.
    """

    symbol: str
    start: int
    stress: int
    closure: int
    position: int


@dataclass(frozen=True, slots=True)
class Rendition:
    """A spoken stretch: int16 samples (n,), its phones in order, the names of sounds that were guessed."""

    samples: Samples
    sample_rate: int
    phones: tuple[SpokenPhone, ...]
    guessed: tuple[str, ...] = ()


class SpeechEngine(Protocol):
    """A speech engine. All methods may raise SpeechError, and may be called from any thread."""

    def speak(self, request: SpeechRequest) -> Rendition:
        """Speak a text. Equal requests give equal bytes."""
        ...

    def transcribe(self, words: Sequence[str], voice: Voice) -> tuple[tuple[str, ...], ...]:
        """Return the phones of each word spoken by itself; none for a word that has no sound."""
        ...

    def voices(self) -> tuple[Voice, ...]:
        """Return all voices, in the order of their names."""
        ...

    def close(self) -> None:
        """Release what the engine holds; a later call takes it up again."""
        ...


# Engines by name; each entry makes (or returns) the engine.
ENGINES: Registry[Callable[[], SpeechEngine]] = Registry("speech engine")
DEFAULT_ENGINE = "espeak"
# Voices that are files, by suffix: what makes the engine from the file and a language (BCP 47, None: its
# own).
VOICE_FILES: Registry[Callable[[Path, str | None], SpeechEngine]] = Registry("voice file")


def load_engine(name: str = DEFAULT_ENGINE) -> SpeechEngine:
    """Return the speech engine called `name`; raise ParameterError if there is none."""
    from . import espeak  # noqa: F401 - registers itself

    return ENGINES.get(name)()


def is_voice_file(name: str | None) -> bool:
    """Tell whether a voice is named by its file: there is one, or the name can be nothing else."""
    if not name or "\0" in name:
        return False
    path = Path(name)
    return path.is_absolute() or name[0] == "." or path.suffix.lower() in (".onnx", ".py") or path.is_file()


def load_voice_file(name: str, language: str | None = None) -> SpeechEngine:
    """Return the engine of a voice that is a file; raise SpeechError if there is none, or it is no voice."""
    from . import piper, program  # noqa: F401 - register themselves

    path = Path(name)
    if not path.is_file():
        raise SpeechError(f"there is no voice '{name}'; expected a program or a Piper model (.onnx)")
    suffix = path.suffix.lower()
    return VOICE_FILES.get(suffix if suffix in VOICE_FILES else "")(path, language)
