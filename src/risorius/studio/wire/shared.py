"""Messages of both sides: a script or recording, the choices and emotions that a take is performed from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

from ...core.units import Seconds, Share
from ...reading.hints import Range
from ...speech.structure.edges_moved import EdgeShift
from .choices import choices_class

Whole = Annotated[int, Range(0, 2**31)]
Format = Literal["text", "xml", "utt", "ssml", "bml", "apml", "score", "TextGrid"]


@dataclass(frozen=True, slots=True)
class EmotionSpan:
    """An emotion over the whole clip, over seconds, or over characters [first, last) of the text."""

    emotion: str
    intensity: Share
    start: Seconds | None = None
    end: Seconds | None = None
    first: Whole | None = None
    last: Whole | None = None


if TYPE_CHECKING:
    Choices = Any
else:
    Choices = choices_class(__name__)


@dataclass(frozen=True, slots=True)
class Source:
    """The source of a take: a script as text of a format, or a recording by the name of its upload.

    With a recording, the text is its transcript; if the text is empty, the words are recognized.
    `edges`: where phones begin elsewhere than was found.
    """

    script: str = ""
    format: Format = "text"
    recording: str | None = None
    edges: tuple[EdgeShift, ...] = ()


@dataclass(frozen=True, slots=True)
class TakeInputs:
    """The inputs of a take: the fields of the request `perform`."""

    source: Source
    choices: Choices
    emotions: tuple[EmotionSpan, ...]
