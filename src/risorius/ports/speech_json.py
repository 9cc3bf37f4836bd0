"""The speech that a score belongs to: phones, words and the place of the sound."""

from __future__ import annotations

import os
import wave
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..core.audio import Audio, silence
from ..core.utterance import Accent, Boundary, Pause, Phone, Phrase, Syllable, Utterance, Word
from .node import Node
from .records import from_record, to_record

_PARTS: dict[str, type[Any]] = {
    "phones": Phone,
    "words": Word,
    "syllables": Syllable,
    "pauses": Pause,
    "accents": Accent,
    "boundaries": Boundary,
    "phrases": Phrase,
}
_KEYS = ("language", "text", "audio", "sample_rate", *_PARTS)
_SAMPLE_RATE = 22_050
_MAX_SAMPLE_RATE = 768_000


def speech_to_json(utterance: Utterance, voice: Path | None, folder: Path) -> dict[str, Any]:
    """Return an utterance as an object; `audio` is the way from `folder` to the sound file `voice`."""
    record: dict[str, Any] = {"language": utterance.language, "text": utterance.text}
    record["sample_rate"] = utterance.audio.sample_rate
    if voice is not None:
        record["audio"] = Path(os.path.relpath(os.path.realpath(voice), os.path.realpath(folder))).as_posix()
    for name in _PARTS:
        record[name] = [to_record(item) for item in getattr(utterance, name)]
    return record


def speech_from_json(node: Node, folder: Path, duration: float) -> Utterance:
    """Return the utterance that an object describes; sound is looked for from `folder` on.

    Without `audio` it is silent, as long as the phones. `duration` is the score's, in seconds. Raises
    InputError with the place, also if the phones do not cover the sound.
    """
    entries = node.entries(_KEYS, ("language", "phones"))
    parts: dict[str, tuple[Any, ...]] = {}
    for name, kind in _PARTS.items():
        nodes = entries[name].items() if name in entries else []
        parts[name] = tuple(from_record(kind, node) for node in nodes)
    _check_parts(entries, parts)
    language = entries["language"].text()
    text = entries["text"].text() if "text" in entries else ""
    if "audio" in entries:
        audio = _audio(entries["audio"], folder)
    else:
        audio, parts["phones"] = _silent(entries, parts["phones"], duration)
    with entries["phones"].located():
        return Utterance(text, language, audio, **parts)


def _check_parts(entries: dict[str, Node], parts: dict[str, tuple[Any, ...]]) -> None:
    """Raise InputError for an unknown stress, and for a phone, word or syllable that is not there."""
    counts = {name: len(parts[name]) for name in _PARTS}
    within: dict[str, Callable[[Any], bool]] = {
        "phones": lambda p: -1 <= p.word < counts["words"],
        "words": lambda w: 0 <= w.first_phone <= w.last_phone <= counts["phones"],
        "syllables": lambda s: (
            0 <= s.first_phone <= s.last_phone <= counts["phones"] and -1 <= s.word < counts["words"]
        ),
        "accents": lambda a: -1 <= a.word < counts["words"] and -1 <= a.syllable < counts["syllables"],
        "boundaries": lambda b: -1 <= b.word < counts["words"],
    }
    for node, phone in zip(entries["phones"].items(), parts["phones"], strict=True):
        if not -1 <= phone.stress <= 2:
            raise node.fault(f"stress {phone.stress} is out of range; expected -1 to 2")
    for name, valid in within.items():
        nodes = entries[name].items() if name in entries else []
        for node, item in zip(nodes, parts[name], strict=True):
            if not valid(item):
                raise node.fault("refers to a phone, word or syllable that is not there")


def _silent(
    entries: dict[str, Node], phones: tuple[Phone, ...], duration: float
) -> tuple[Audio, tuple[Phone, ...]]:
    """Return silence as long as the phones, and the phones, the last ending with a whole sample."""
    rate = entries["sample_rate"].integer() if "sample_rate" in entries else _SAMPLE_RATE
    if not 0 < rate <= _MAX_SAMPLE_RATE:
        raise entries["sample_rate"].fault(f"{rate} is out of range; expected 1 to {_MAX_SAMPLE_RATE}")
    if not phones or not 0.0 < phones[-1].end <= duration + 1.0:
        raise entries["phones"].fault(f"the phones do not end within the duration, {duration:g} s")
    audio = silence(phones[-1].end, rate)
    return audio, (*phones[:-1], replace(phones[-1], end=audio.duration))


def _audio(node: Node, folder: Path) -> Audio:
    name = node.text()
    if Path(name).is_absolute():
        raise node.fault(f"'{name}' is an absolute path; expected one from the score's folder on")
    path = folder / name
    try:
        with wave.open(str(path), "rb") as file:
            if (file.getnchannels(), file.getsampwidth()) != (1, 2):
                raise node.fault(f"'{name}' is not 16-bit mono")
            return Audio(path, file.getframerate(), file.getnframes())
    except (OSError, EOFError, wave.Error) as error:
        reason = getattr(error, "strerror", None) or str(error) or "not a WAV file"
        raise node.fault(f"'{name}' cannot be read ({reason}); expected a 16-bit mono WAV file") from None
