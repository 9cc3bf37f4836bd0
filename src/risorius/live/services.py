"""Speech services that send a voice in pieces, with the times of its words: their messages for `Live.say`.

Each class follows one answer of a service, by the format that it publishes, and holds what it must know of
the messages before. No service is asked for anything here.
"""

from __future__ import annotations

import base64
import binascii
from collections.abc import Mapping, Sequence
from datetime import timedelta
from typing import Any, TypeVar

from ..errors import InputError, unknown
from ..reading.schema import build
from ..reading.source_text import SourceText, Syntax
from .pcm import sample_bytes
from .session import Live

T = TypeVar("T")
Message = Mapping[str, Any]
Object = dict[str, Any]
Texts, Times = tuple[str, ...], tuple[float, ...]
TimedWords = list[tuple[str, float, float]]
# Azure's unit of time, seconds.
_TICK = 1e-7
# Both spellings are published.
_STARTS = ("charStartTimesMs", "charsStartTimesMs")
_LENGTHS = ("charDurationsMs", "charsDurationsMs")
_LONGEST_RATE = 7
_ELEVENLABS = {"pcm": "pcm_s16le", "ulaw": "pcm_mulaw", "alaw": "pcm_alaw"}


class ElevenLabsVoice:
    """The messages of ElevenLabs' WebSocket `stream-input` (and of `stream/with-timestamps`).

    `output_format`: that which was asked for, `pcm_24000` or `ulaw_8000`. Characters' times are counted from
    the beginning of each message's sound.
    """

    def __init__(self, face: Live, output_format: str) -> None:
        """Raise InputError for a format that is not plain samples."""
        kind, _, rate = output_format.partition("_")
        if kind not in _ELEVENLABS or not (rate.isdecimal() and len(rate) < _LONGEST_RATE):
            message = unknown("output format", output_format, ("pcm_16000", "pcm_24000", "ulaw_8000"))
            raise InputError(message)
        self._face, self._encoding, self._rate = face, _ELEVENLABS[kind], int(rate)
        self._seconds = 0.0
        # Characters of a word that may go on in the next message, with their times.
        self._word: list[tuple[str, float, float]] = []

    def say(self, message: Message) -> None:
        """Let the face say the content of a message; raises InputError for a message of another form."""
        content = _part(Object, message)
        data = _decoded(content.get("audio") or content.get("audio_base64") or "")
        alignment = content.get("alignment") or content.get("normalizedAlignment") or {}
        words = self._words(_part(Object, alignment, "alignment"))
        is_last = bool(content.get("isFinal"))
        if is_last:
            words += self._ended()
        self._seconds += len(data) / sample_bytes(self._encoding) / self._rate
        if data or words:
            self._face.say(audio=data, rate=self._rate, encoding=self._encoding, words=words)
        if is_last:
            self._face.flush()
            self._seconds = 0.0

    def _words(self, alignment: Object) -> TimedWords:
        characters, starts, ends = _times(alignment)
        words: TimedWords = []
        for character, start, end in zip(characters, starts, ends, strict=True):
            if character.isspace():
                words += self._ended()
            else:
                self._word.append((character, self._seconds + start, self._seconds + end))
        return words

    def _ended(self) -> TimedWords:
        """Return the word that has ended, if there is one."""
        if not self._word:
            return []
        text = "".join(character for character, _, _ in self._word)
        word = text, self._word[0][1], self._word[-1][2]
        self._word = []
        return [word]


def _times(alignment: Object) -> tuple[Sequence[str], Sequence[float], Sequence[float]]:
    """Return characters with start and end in seconds, as the WebSocket or the other interface names them."""
    if "characters" in alignment:
        characters = _member(Texts, alignment, "characters")
        starts = _member(Times, alignment, "character_start_times_seconds")
        ends = _member(Times, alignment, "character_end_times_seconds")
    else:
        characters = _member(Texts, alignment, "chars")
        starts, lasting = (
            tuple(ms / 1e3 for ms in _member(Times, alignment, *names)) for names in (_STARTS, _LENGTHS)
        )
        ends = tuple(start + length for start, length in zip(starts, lasting, strict=False))
    if not len(characters) == len(starts) == len(ends):
        raise InputError("the alignment's characters and times do not match; expected one for each")
    return characters, starts, ends


class CartesiaVoice:
    """The messages of Cartesia's WebSocket `tts/websocket`: `chunk`, `timestamps`, `flush_done`, `done`.

    `encoding` and `rate`: those of the `output_format` that was asked for. Words' times are counted from the
    beginning of the context.
    """

    def __init__(self, face: Live, encoding: str, rate: int) -> None:
        """Raise InputError for an unknown encoding."""
        sample_bytes(encoding)
        self._face, self._encoding, self._rate = face, encoding, rate

    def say(self, message: Message) -> None:
        """Let the face say the content of a message; raises InputError for a message of another form."""
        content = _part(Object, message)
        kind = content.get("type")
        if kind == "chunk":
            self._add(_decoded(content.get("data", "")), [])
        elif kind == "timestamps":
            times = _part(Object, content.get("word_timestamps") or {}, "word_timestamps")
            words, starts = _member(Texts, times, "words"), _member(Times, times, "start")
            ends = _member(Times, times, "end")
            if "words" not in times or not len(words) == len(starts) == len(ends):
                raise InputError("word_timestamps do not match; expected words, start and end")
            self._add(b"", list(zip(words, starts, ends, strict=True)))
        elif kind == "done":
            self._face.flush()
        elif kind == "error":
            raise InputError(f"the service failed: {content.get('title') or content.get('error')}")

    def _add(self, data: bytes, words: TimedWords) -> None:
        self._face.say(audio=data, rate=self._rate, encoding=self._encoding, words=words)


class AzureVoice:
    """The events of Azure's speech SDK: `synthesizing` with sound, `synthesis_word_boundary` with a word.

    `encoding` and `rate`: those of the raw output format that was asked for. Times are counted from the
    beginning of the synthesis, in ticks of 100 ns.
    """

    def __init__(self, face: Live, encoding: str = "pcm_s16le", rate: int = 24_000) -> None:
        """Raise InputError for an unknown encoding."""
        sample_bytes(encoding)
        self._face, self._encoding, self._rate = face, encoding, rate
        self._word: tuple[str, float, float] | None = None

    def word(
        self, text: str, audio_offset: int, duration: float | timedelta, boundary_type: object = "Word"
    ) -> None:
        """Take a word boundary: `audio_offset` in ticks, `duration` in seconds, as the SDK has them.

        A punctuation mark belongs to the word before it; whole sentences are left alone.
        """
        text = _part(str, text, "text")
        kind = str(getattr(boundary_type, "name", boundary_type)).lower()
        if kind.startswith("punctuation"):
            if self._word is not None:
                self._word = (self._word[0] + text, *self._word[1:])
        elif kind.startswith("word"):
            self._send()
            start = _part(float, audio_offset, "audio_offset") * _TICK
            seconds = duration.total_seconds() if isinstance(duration, timedelta) else duration
            self._word = text, start, start + _part(float, seconds, "duration")

    def sound(self, data: bytes) -> None:
        """Take a piece of sound, after the words that begin in it."""
        self._send()
        self._face.say(audio=data, rate=self._rate, encoding=self._encoding)

    def end(self) -> None:
        """Take the end of the synthesis."""
        self._send()
        self._face.flush()

    def _send(self) -> None:
        if self._word is not None:
            word, self._word = self._word, None
            self._face.say(audio=b"", rate=self._rate, encoding=self._encoding, words=[word])


def _part(kind: type[T], value: object, name: str = "") -> T:
    """Return a message, or the part of it of that name, as a type; raises InputError if it is another."""
    return build(kind, value, SourceText("the message", syntax=Syntax.JSON), (name,) if name else ())


def _member(kind: type[T], part: Object, *names: str) -> T:
    """Return a list in a part of a message, under one of its names; empty if it is not there.

    Raises InputError as `_part`.
    """
    name = next((name for name in names if name in part), names[0])
    return _part(kind, part.get(name, []), name)


def _decoded(text: object) -> bytes:
    try:
        return base64.b64decode(_part(str, text, "audio"), validate=True)
    except (binascii.Error, ValueError):
        raise InputError("the message's sound is not base64; expected samples in base64") from None
