"""The interface of speech engines, which turn a stretch of text into sound with timed phones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

from ...core.directions import Break, DirectedSpan
from ...core.speech.audio import Samples
from ...core.speech.voice_style import PLAIN, VoiceAdjustment


@dataclass(frozen=True, slots=True)
class Voice:
    """A voice: the name by which users choose it, its languages (BCP 47, lower case), gender, description.

    The first language is its own, the others are wider ones. `gender` is "male", "female" or "" if
    unknown. `key` is what the engine calls it.
    """

    name: str
    languages: tuple[str, ...]
    gender: str
    description: str
    key: str

    @property
    def language(self) -> str:
        """The language of the voice; "" for a voice that is only a variant of others."""
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
    manner: VoiceAdjustment = PLAIN
    directions: tuple[DirectedSpan | Break, ...] = ()


class SpokenPhone(NamedTuple):
    """A phone that starts at sample `start` and lasts to the start of the next one.

    `symbol` is ARPAbet for English, IPA for other languages, "" for silence. `stress` as in core's Phone.
    `closure`: by how many samples the articulators close before `start`, as far as the engine knows.
    `position`: index in the text of the word it belongs to. `tone` as in core's Phone.
    """

    symbol: str
    start: int
    stress: int
    closure: int
    position: int
    tone: str = ""


@dataclass(frozen=True, slots=True)
class Rendition:
    """A spoken stretch: int16 samples (n,), its phones in order, the names of sounds that were guessed."""

    samples: Samples
    sample_rate: int
    phones: tuple[SpokenPhone, ...]
    guessed: tuple[str, ...] = ()


class SpeechEngine(Protocol):
    """A speech engine. All methods may raise SpeechError, and may be called from any thread."""

    def synthesize(self, request: SpeechRequest) -> Rendition:
        """Speak a text. Equal requests give equal bytes."""
        ...

    def transcribe(self, words: Sequence[str], voice: Voice) -> tuple[tuple[str, ...], ...]:
        """Return the phones of each word spoken by itself; none for a word that has no sound."""
        ...

    def voices(self) -> tuple[Voice, ...]:
        """Return all voices, in the order of their names."""
        ...

    def mean_pitch(self, voice: Voice) -> float | None:
        """Return the mean pitch of a voice in Hz, None if it is not known."""
        ...

    def close(self) -> None:
        """Release the engine's resources; a later call acquires them again."""
        ...
