"""The voices of espeak-ng: their list, and how high they are."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .protocol import Voice

# The range of pitch in Hz of a voice whose file has none, and where in its range the mean pitch of vowels is:
# measured on six voices, it is right to within a semitone.
_USUAL_RANGE = (82.0, 118.0)
_MEAN_SHARE = 0.6


def listed_voices(answer: dict[str, Any], data: Path) -> tuple[Voice, ...]:
    """Return the voices and variants of a worker's answer, in the order of their names.

    Voices whose dictionary is not in espeak-ng's `data` are left out: they cannot say a word.
    """
    voices: dict[str, Voice] = {}
    for entry in sorted(answer["voices"], key=lambda v: v["identifier"]):
        if not _has_dictionary(data, entry["identifier"], entry["languages"][0]):
            continue
        languages = tuple(language.lower() for language in entry["languages"])
        name = languages[0]
        if name in voices:
            name = entry["identifier"].split("/")[-1].lower()
        voices[name] = Voice(name, languages, entry["gender"], entry["name"].strip(), entry["identifier"])
    for entry in answer["variants"]:
        key = entry["identifier"].split("/")[-1]
        voices[f"+{key}"] = Voice(f"+{key}", (), entry["gender"], entry["name"].strip(), f"+{key}")
    return tuple(voices[name] for name in sorted(voices, key=str.lower))


def _has_dictionary(data: Path, key: str, language: str) -> bool:
    own = data / f"{language.split('-')[0]}_dict"
    return own.is_file() or any(line[:1] == ["dictionary"] for line in _lines(data / "lang" / key))


def mean_pitch(data: Path, key: str) -> float:
    """Return the mean pitch in Hz of the voice `key` by its files in espeak-ng's `data`.

    A variant's own range replaces that of the voice.
    """
    base, _, variant = key.partition("+")
    files = [data / "voices" / "!v" / variant] if variant else []
    ranges = (_pitch_range(path) for path in (*files, data / "lang" / base))
    low, high = next(filter(None, ranges), _USUAL_RANGE)
    return low + _MEAN_SHARE * (high - low)


def _pitch_range(path: Path) -> tuple[float, float] | None:
    """Return the numbers of the line "pitch" of a voice's file; None without one."""
    for line in _lines(path):
        match line:
            case ["pitch", low, high, *_]:
                return float(low), float(high)
    return None


def _lines(path: Path) -> list[list[str]]:
    """Return the words of each line of a voice's file; none without one."""
    text = path.read_text("utf-8", "replace") if path.is_file() else ""
    return [line.split() for line in text.splitlines()]
