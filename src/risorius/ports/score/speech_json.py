"""The speech that a score belongs to: phones, words and the place of the sound."""

from __future__ import annotations

import os
import wave
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any

from ...core.speech.audio import Audio, silence
from ...core.speech.utterance import (
    Accent,
    Boundary,
    NamedTime,
    Pause,
    Phone,
    Phrase,
    Syllable,
    Utterance,
    Word,
)
from ...errors import warn
from ...reading.hints import Range
from ...reading.schema import MisfitError
from ..layout import to_record

_PARTS = ("phones", "words", "syllables", "pauses", "accents", "boundaries", "phrases", "marks")
# Parts that are written only if there are any.
_RARE = ("marks",)
_SAMPLE_RATE = 22_050


@dataclass(frozen=True, slots=True)
class SpeechDocument:
    """The utterance in a score's file; `audio` is the sound's path relative to the file's folder."""

    language: str
    phones: tuple[Phone, ...]
    words: tuple[Word, ...] = ()
    syllables: tuple[Syllable, ...] = ()
    pauses: tuple[Pause, ...] = ()
    accents: tuple[Accent, ...] = ()
    boundaries: tuple[Boundary, ...] = ()
    phrases: tuple[Phrase, ...] = ()
    marks: tuple[NamedTime, ...] = ()
    text: str = ""
    audio: str | None = None
    sample_rate: Annotated[int, Range(1, 768_000)] = _SAMPLE_RATE

    def utterance(self, folder: Path, duration: float) -> Utterance:
        """Return the utterance; the sound is looked for from `folder` on.

        Without `audio` it is silent, as long as the phones. `duration` is the score's, in seconds. Raises
        MisfitError, also if the phones do not cover the sound.
        """
        self._check_parts()
        phones = self.phones
        if self.audio is not None:
            audio = _audio(self.audio, folder)
        else:
            audio, phones = self._silent(duration)
        parts = {name: getattr(self, name) for name in _PARTS} | {"phones": phones}
        try:
            return Utterance(self.text, self.language, audio, **parts)
        except ValueError as error:
            raise MisfitError(
                f"{error}; expected phones one after another, and phrases of them", "phones"
            ) from None

    def _check_parts(self) -> None:
        """Raise MisfitError for a part that ends before it starts, and for a missing part."""
        for name, is_within in _REFERENCES.items():
            for number, part in enumerate(getattr(self, name)):
                if not is_within(part, self):
                    message = (
                        "refers to a phone, word or syllable that does not exist; expected the number of one"
                    )
                    raise MisfitError(message, name, number)
        for name in _SPANS:
            for number, part in enumerate(getattr(self, name)):
                if part.end < part.start:
                    message = (
                        f"ends at {part.end:g} s, before it starts at {part.start:g} s; expected a later end"
                    )
                    raise MisfitError(message, name, number)

    def _silent(self, duration: float) -> tuple[Audio, tuple[Phone, ...]]:
        """Return silence as long as the phones, and the phones, the last ending with a whole sample."""
        phones = self.phones
        if not phones or not 0.0 < phones[-1].end <= duration + 1.0:
            message = f"the phones do not end within the duration; expected an end up to {duration:g} s"
            raise MisfitError(message, "phones")
        audio = silence(phones[-1].end, self.sample_rate)
        return audio, (*phones[:-1], replace(phones[-1], end=audio.duration))


_SPANS = ("words", "syllables", "pauses", "phrases")
_REFERENCES: Mapping[str, Callable[[Any, SpeechDocument], bool]] = MappingProxyType(
    {
        "phones": lambda phone, utterance: -1 <= phone.word < len(utterance.words),
        "words": lambda word, utterance: 0 <= word.first_phone <= word.last_phone <= len(utterance.phones),
        "syllables": lambda syllable, utterance: (
            0 <= syllable.first_phone <= syllable.last_phone <= len(utterance.phones)
            and -1 <= syllable.word < len(utterance.words)
        ),
        "accents": lambda accent, utterance: (
            -1 <= accent.word < len(utterance.words) and -1 <= accent.syllable < len(utterance.syllables)
        ),
        "boundaries": lambda boundary, utterance: -1 <= boundary.word < len(utterance.words),
    }
)
"""Whether the numbers in a part are those of other parts."""


def _audio(name: str, folder: Path) -> Audio:
    if Path(name).is_absolute():
        raise MisfitError(
            f"'{name}' is an absolute path; expected one relative to the score's folder", "audio"
        )
    path = folder / name
    try:
        if not _is_inside(path, folder):
            message = f"'{name}' is outside of the score's folder; expected a sound in it or below"
            raise MisfitError(message, "audio")
        with wave.open(str(path), "rb") as file:
            form = (file.getnchannels(), file.getsampwidth(), file.getframerate() > 0)
            if form != (1, 2, True):
                raise MisfitError(f"'{name}' is not 16-bit mono; expected a 16-bit mono WAV file", "audio")
            return Audio(path, file.getframerate(), file.getnframes())
    except (OSError, EOFError, ValueError, wave.Error) as error:
        reason = getattr(error, "strerror", None) or str(error) or "not a WAV file"
        message = f"'{name}' cannot be read ({reason}); expected a 16-bit mono WAV file"
        raise MisfitError(message, "audio") from None


def _is_inside(path: Path, folder: Path) -> bool:
    """Whether a file is in a folder or below, links followed: a score reads no other file of its user."""
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def speech_to_json(utterance: Utterance, voice: Path | None, folder: Path) -> dict[str, Any]:
    """Return an utterance as an object; `audio` is the way from `folder` to the sound file `voice`.

    Warns, and leaves it out, if the sound is outside of the folder: it would not be read back.
    """
    record: dict[str, Any] = {"language": utterance.language, "text": utterance.text}
    record["sample_rate"] = utterance.audio.sample_rate
    if voice is not None and not _is_inside(voice, folder):
        warn(f"{voice}: is outside of the score's folder; the score refers to no sound")
    elif voice is not None:
        record["audio"] = Path(os.path.relpath(os.path.realpath(voice), os.path.realpath(folder))).as_posix()
    for name in _PARTS:
        items = getattr(utterance, name)
        if items or name not in _RARE:
            record[name] = [to_record(item) for item in items]
    return record
