"""Messages of clients, decoded strictly into dataclasses, whose fields are the keys of the messages.

docs/serve.md describes the messages; a change that breaks a client raises `VERSION`.
"""

from __future__ import annotations

import base64
import binascii
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Annotated, Any

import numpy as np

from ...core.speech.audio import Samples
from ...errors import InputError, unknown
from ...reading.frozen import FrozenDict
from ...reading.hints import Range
from ...reading.json_object import json_object, without_nulls
from ...reading.schema import build
from ...reading.source_text import SourceText, Syntax
from . import limits

VERSION = 1


class FrameFormat(StrEnum):
    """The format of frames."""

    JSON = "json"
    BINARY = "binary"


class Output(StrEnum):
    """A part of a frame beside its sound."""

    PARAMETERS = "parameters"
    ARKIT = "arkit"
    ROTATIONS = "rotations"
    RIG = "rig"


@dataclass(frozen=True, slots=True)
class StartFace:
    """The first message: the wishes. `ahead`: seconds by which frames come before they are due."""

    version: int
    fps: float | str = 30
    format: FrameFormat = FrameFormat.JSON
    outputs: tuple[Output, ...] = (Output.ARKIT, Output.ROTATIONS)
    ahead: Annotated[float, Range(0.0, limits.AHEAD)] = 0.2
    settings: Mapping[str, object] = field(default_factory=FrozenDict)
    token: str | None = None


@dataclass(frozen=True, slots=True)
class Say:
    """Text that is to be said, cut anywhere; or a piece of a voice that says it, in base64.

    `words`: words of the voice with their start and end in seconds, counted from its beginning or from the
    last `flush`.
    """

    text: str | None = None
    audio: str | None = None
    rate: int | None = None
    encoding: str = "pcm_s16le"
    words: tuple[tuple[str, float, float], ...] = ()

    def __post_init__(self) -> None:
        if self.text is None and self.audio is None:
            raise InputError("it has no text; expected text, or audio with its rate")

    @property
    def sound(self) -> bytes | None:
        """The voice's bytes, if there are any; raises InputError if they are not base64."""
        return None if self.audio is None else _bytes_of(self.audio)


@dataclass(frozen=True, slots=True)
class LookAt:
    """A direction to look in, by name or by pitch and yaw in degrees; without one, as the face likes."""

    target: str | None = None
    pitch: float | None = None
    yaw: float | None = None

    @property
    def direction(self) -> str | tuple[float, float] | None:
        """The target's name or (pitch, yaw); raises InputError unless exactly one of the two is complete."""
        if self.pitch is None and self.yaw is None:
            return self.target
        if self.target is not None or self.pitch is None or self.yaw is None:
            raise InputError("give either a target, or both pitch and yaw")
        return self.pitch, self.yaw


@dataclass(frozen=True, slots=True)
class Feel:
    """An emotion that is to be shown."""

    emotion: str
    intensity: float


@dataclass(frozen=True, slots=True)
class Listen:
    """A piece of the other's speech: 16-bit samples, little-endian, one channel, in base64."""

    audio: str
    rate: int

    @property
    def samples(self) -> Samples:
        """The samples; raises InputError if they cannot be decoded."""
        return samples_of(self.audio)


@dataclass(frozen=True, slots=True)
class Flush:
    """The sentence that waits is whole."""


@dataclass(frozen=True, slots=True)
class Interrupt:
    """Fall silent."""


@dataclass(frozen=True, slots=True)
class Close:
    """Say the text that has arrived, and end."""


ClientMessage = StartFace | Say | LookAt | Feel | Listen | Flush | Interrupt | Close
KINDS: Mapping[str, type[ClientMessage]] = {
    "start": StartFace,
    "say": Say,
    "look": LookAt,
    "feel": Feel,
    "listen": Listen,
    "flush": Flush,
    "interrupt": Interrupt,
    "close": Close,
}
"""The messages by their name in `do`."""


def decode(text: str) -> ClientMessage:
    """Return the message that a text is; raise InputError with one line on what is wrong."""
    data = json_object(text)
    kind = data.pop("do", None)
    if not isinstance(kind, str) or kind not in KINDS:
        raise InputError(unknown("message", str(kind)[:40], tuple(KINDS)))
    message: Any = build(KINDS[kind], without_nulls(data), SourceText(kind, syntax=Syntax.JSON))
    if isinstance(message, Say) and len(message.text or "") > limits.TEXT:
        raise InputError(
            f"a text of {len(message.text or ''):,} characters; expected at most {limits.TEXT:,}"
        )
    return message  # type: ignore[no-any-return]


def samples_of(text: str) -> Samples:
    """Return 16-bit samples from base64; raise InputError for anything else."""
    sound = _bytes_of(text)
    if len(sound) % 2:
        raise InputError(f"the sound has {len(sound):,} bytes; expected 2 for each sample")
    return np.frombuffer(sound, "<i2").astype(np.int16)


def _bytes_of(text: str) -> bytes:
    try:
        return base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise InputError("the sound is not base64; expected samples in base64") from None
