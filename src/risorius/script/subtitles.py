"""Subtitles (`.srt`, `.vtt`) as a transcript: the words of each cue, and when it is shown."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import InputError, Place
from .transcript import without_speakers, without_tags

SUBTITLE_SUFFIXES = (".srt", ".vtt")
_ARROW = "-->"
_STAMP = r"(?:(\d{1,3}):)?(\d{1,2}):(\d{1,2})[.,](\d{1,3})"
_TIMING = re.compile(rf"^\s*{_STAMP}\s*-->\s*{_STAMP}(?:\s.*)?$")
_TAG = re.compile(r"</?[A-Za-z][^<>\n]{0,80}>|<\d[\d:.]{0,20}>|\{\\[^{}\n]{0,80}\}")


@dataclass(frozen=True, slots=True)
class TimedText:
    """The words of a cue, shown from `start` to `end` seconds, and its place in the file."""

    text: str
    start: float
    end: float
    place: Place


def looks_like_subtitles(text: str) -> bool:
    """Tell whether a text has the timing of a cue in one of its first lines."""
    return any(_TIMING.match(line) for line in text.splitlines()[:40])


def read_subtitles(text: str, source: str, *, keep_tags: bool = False) -> tuple[TimedText, ...]:
    """Return the cues that have words, in the order of their times.

    Tags of style, and unless `keep_tags` tags such as `[laughs]` and speakers' names, are no words. Raises
    InputError, with its place, for a file without cues, and for a cue that ends before it starts.
    """
    cues = tuple(_cues(text, source))
    if not cues:
        raise InputError("has no cue; expected e.g. 00:00:01,000 --> 00:00:02,500", Place(source, 1))
    whole = "\n\n".join(cue.text for cue in cues)
    if not keep_tags:
        whole = without_tags(whole, known_only=False).text
        whole = without_speakers(whole).text
    parts = whole.split("\n\n")
    kept = (
        TimedText(part, cue.start, cue.end, cue.place)
        for cue, part in zip(cues, parts, strict=True)
        if any(character.isalnum() for character in part)
    )
    return tuple(sorted(kept, key=lambda cue: cue.start))


def _cues(text: str, source: str) -> Iterator[TimedText]:
    lines = text.splitlines()
    for number, line in enumerate(lines):
        timing = _TIMING.match(line)
        if timing is None:
            continue
        start, end = _seconds(timing.groups()[:4]), _seconds(timing.groups()[4:])
        place = Place(source, number + 1)
        if end < start:
            raise InputError(f"ends at {end:g} s, before it starts at {start:g} s", place)
        words: list[str] = []
        for following in (lines[k] for k in range(number + 1, len(lines))):
            if not following.strip() or _ARROW in following:
                break
            words.append(following)
        if number + 1 + len(words) < len(lines) and _ARROW in lines[number + 1 + len(words)] and words:
            words.pop()  # the number of the next cue
        plain = html.unescape(_TAG.sub("", "\n".join(words)))
        yield TimedText(re.sub(r"\n\s*\n", "\n", plain).strip(), start, end, place)


def _seconds(parts: tuple[str | None, ...]) -> float:
    hours, minutes, seconds, fraction = (part or "0" for part in parts)
    return 3600.0 * int(hours) + 60.0 * int(minutes) + float(f"{seconds}.{fraction}")
