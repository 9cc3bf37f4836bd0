"""Inputs of `speak` and `stream`: a text, a file, standard input, or a recording and its words."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..errors import InputError, UnreadError
from .options import F, emotion_option, option

if TYPE_CHECKING:
    from ..core.progress import Progress
    from ..settings import Settings
    from ..take import Take

LONGEST_INPUT = 4_000_000


@dataclass(frozen=True, slots=True)
class Spoken:
    """INPUT and the options of `input_options`; raises RisoriusError if nothing is left to perform."""

    source: str | None
    is_text: bool
    emotions: tuple[str, ...]
    audio: str | None
    transcript: str | None

    def __post_init__(self) -> None:
        if self.source is None and self.audio is None:
            raise InputError("nothing to perform; expected a text, a file or --audio")
        if self.source is None and self.is_text:
            raise UnreadError(["text"], "INPUT is missing; expected a text, or --transcript TEXT")

    def perform(self, settings: Settings, progress: Progress) -> Take:
        """Perform it; `-` is the text on standard input."""
        from ..api import speak

        return speak(**self._arguments(), settings=settings, progress=progress)

    def perform_to_draw(self, settings: Settings, progress: Progress) -> Take:
        """Perform it, and load the renderer meanwhile."""
        from ..speaking import speak_and_prepare

        return speak_and_prepare(self._arguments(), settings, progress)

    def _arguments(self) -> dict[str, Any]:
        source, name = (self.source, "text") if self.source != "-" else (_standard_input(), "stdin")
        return {
            "script": source,
            "audio": self.audio,
            "transcript": self.transcript,
            "text": self.is_text or name == "stdin",
            "source": name,
            "emotion": self.emotions,
        }


_OPTIONS: tuple[Callable[[Any], Any], ...] = (
    option(
        "--text",
        "is_text",
        group="Input",
        is_flag=True,
        help="Speak INPUT as text, even if it looks like a file name.",
    ),
    emotion_option,
    option(
        "--audio",
        group="Input",
        metavar="FILE",
        help="A recorded voice: WAV, FLAC, OGG, MP3, M4A, or the sound of a film.",
    ),
    option(
        "--transcript",
        group="Input",
        metavar="TEXT|FILE",
        help="The words of the recording, or a file that holds them.  [default: INPUT]",
    ),
)


def input_options(command: F) -> F:
    """Give a command the options of its input."""
    for add in reversed(_OPTIONS):
        command = add(command)
    return command


def _standard_input() -> str:
    from ..script.files import decode

    if sys.stdin is None:
        raise InputError("standard input is closed; expected a text on it")
    return decode(sys.stdin.buffer.read(LONGEST_INPUT), "stdin")
