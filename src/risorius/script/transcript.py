"""Transcripts as people write them: tags, speakers' names and times at a line's start are not words.

Each character stays at its place: the others are hidden, and named.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from ..core.speech.characters import HIDDEN
from ..rules.tags import tag_table
from .markdown import LeftOut, PlainText

_SQUARE = re.compile(
    r"\[[^\[\]\n]{1,60}\]|\{[^{}\n]{1,60}\}|<[A-Za-z/][^<>\n]{0,60}>|\u3010[^\u3010\u3011\n]{1,30}\u3011"
)
_ROUND = re.compile(
    r"\([^()\n]{1,60}\)|\uff08[^\uff08\uff09\n]{1,30}\uff09|(?<![\w*])\*[^*\n]{1,40}\*(?![\w*])"
)
_NOTE = re.compile("[\u2669-\u266f]")

_LINE = re.compile(r"^[^\S\n]*(?P<rest>[^\n]+)", re.MULTILINE)
# What stands before a name or a time on its line.
_BEFORE = rf"[ \t\r\f\v\u00a0\u2000-\u200a\u2028\u2029\u202f\u3000{HIDDEN}>\u2013-]"
_LEAD = rf"(?<!{_BEFORE}){_BEFORE}*+"
_WORD = r"[\w.'\u2019-]{0,30}"
_NAME = re.compile(
    rf"{_LEAD}(?P<name>[^\W\d_]{_WORD}(?: [A-Z\u00c0-\u00de0-9(][\w.'\u2019)-]{{0,30}}){{0,3}})\s?"
    r"(?P<colon>[:\uff1a])(?=\s|[^\x00-\x7f]|$)"
)
_TIME = re.compile(rf"{_LEAD}(?P<time>(?:\d{{1,2}}:)?\d{{1,2}}:\d{{2}}(?:[.,]\d{{1,3}})?)(?=\s|$)")
_CAST = re.compile(
    r"^[^\S\n]*(?:Speakers?|Cast|Participants?|Characters|Voices|Sprecher|Personen|Intervenants|Hablantes|Personajes)"
    r"[^\S\n]*:[^\S\n]*(?P<names>[^\n]+)",
    re.MULTILINE | re.IGNORECASE,
)


def without_tags(text: str, *, known_only: bool) -> PlainText:
    """Return a text without its tags: `[laughs]`, `(sighs)`.

    In square, curly and angle brackets everything is a tag, unless `known_only`: then, as in round brackets,
    only what names a sound that is not speech.
    """
    found = [m for m in _SQUARE.finditer(text) if not known_only or _is_sound(m[0])]
    found += [m for m in _ROUND.finditer(text) if _is_sound(m[0])]
    if not known_only:
        found += list(_NOTE.finditer(text))
    return _hidden(text, [(m.start(), m.end(), f"the tag {m[0]}") for m in found])


def without_speakers(text: str) -> PlainText:
    """Return a text without the names of speakers, and times, at the starts of lines.

    A name is one that the text declares ("Speakers: Anna, Bo"), or that begins two lines; times are left out
    if they begin two lines and never go back.
    """
    spans: list[tuple[int, int, str]] = []
    declared: set[str] = set()
    for cast in _CAST.finditer(text):
        declared |= {name.strip().lower() for name in re.split(r"[,;&/]| and | und | et | y ", cast["names"])}
        spans.append((cast.start(), cast.end(), "the list of speakers"))
    starts = dict(_times(text))
    named = list(_names(text, starts))
    counts = Counter(name.lower() for name, _, _ in named)
    for name, start, end in named:
        plain = name.lower()
        if plain in declared or (counts[plain] > 1 and plain not in tag_table().label_words):
            spans.append((start, end, f"the name {name}"))
    spans += [(start, end, "the times of lines") for start, end in starts.items()]
    return _hidden(text, spans)


def _is_sound(tag: str) -> bool:
    words = [word.lower() for word in re.findall(r"[^\W\d_]+", tag)]
    if not words or len(words) > len(["one", "two", "three"]):
        return False
    table = tag_table()
    return bool({words[0], words[-1]} & table.sound_words) or words[0] in table.opening_words


def _times(text: str) -> Iterator[tuple[int, int]]:
    """Yield the times at the starts of lines, if there are two or more that never go back."""
    found = [match for line in _LINE.finditer(text) if (match := _TIME.match(text, line.start()))]
    seconds = [_seconds(match["time"]) for match in found]
    if len(found) > 1 and seconds == sorted(seconds):
        yield from ((match.start("time"), match.end("time")) for match in found)


def _seconds(time: str) -> float:
    total = 0.0
    for part in time.replace(",", ".").split(":"):
        total = 60.0 * total + float(part)
    return total


def _names(text: str, times: dict[int, int]) -> Iterator[tuple[str, int, int]]:
    """Yield each name before a colon at the start of a line, with the characters up to the colon's end."""
    for line in _LINE.finditer(text):
        time = _TIME.match(text, line.start())
        at = time.end("time") if time and time.start("time") in times else line.start()
        match = _NAME.match(text, at)
        if match is not None:
            yield match["name"], match.start("name"), match.end("colon")


def _hidden(text: str, spans: list[tuple[int, int, str]]) -> PlainText:
    """Return the text with the spans hidden; line ends stay."""
    characters = list(text)
    for start, end, _ in spans:
        for at in range(start, end):
            if characters[at] != "\n":
                characters[at] = HIDDEN
    left_out = sorted((LeftOut(name, start) for start, _, name in spans), key=lambda part: part.at)
    return PlainText("".join(characters), tuple(left_out))
