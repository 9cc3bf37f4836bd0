"""Dividing a text into stretches that are spoken one at a time.

A stretch ends where a sentence does, or at a blank line; one that is too long is divided at a clause, a
blank, or, failing these, in the midst. The stretches cover every speakable character of the text, in order.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from typing import NamedTuple

from ...languages import Language
from ...languages.abbreviations import is_abbreviation
from .tokens import is_speakable

LIMIT = 400

_CLOSING = r"[\"'\u2019\u201d\u00bb)\]]*+"
# A full stop and the like needs a blank after it, those of scripts without blanks do not.
_END = re.compile(
    rf"(?<![.!?\u2026])(?P<mark>[.!?\u2026]++){_CLOSING}(?=\s|$)|[\u3002\uff01\uff1f\uff0e]++{_CLOSING}"
    rf"|(?<![\u0964\u0965\u061f\u06d4])[\u0964\u0965\u061f\u06d4]++{_CLOSING}(?=\s|$)"
    r"|\u2029|\n[^\S\n]*+(?=\n)|\n(?=\s{0,40}(?:[-*\u2022]|\d{1,9}[.)])\s)"
)
_CLAUSE_END = re.compile(r"[,;:)\u2013\u2014\u3001\uff0c\uff1b](?=\s|[^\W\d]|$)")


class TextStretch(NamedTuple):
    """Characters [start, end) of a text, spoken as one; not `ends_sentence` if a long one was divided."""

    start: int
    end: int
    ends_sentence: bool


def divide(text: str, language: Language, limit: int = LIMIT) -> tuple[TextStretch, ...]:
    """Return the stretches of `text`, none longer than `limit` characters, each with something to speak."""
    stretches: list[TextStretch] = []
    start = 0
    for end in [*_sentence_ends(text, language), len(text)]:
        stretches += _bounded(text, start, end, limit)
        start = end
    return tuple(s for s in stretches if is_speakable(text[s.start : s.end]))


def _sentence_ends(text: str, language: Language) -> Iterator[int]:
    for match in _END.finditer(text):
        if match["mark"] is None or _ends_here(text, match, language):
            yield match.end()


def _ends_here(text: str, match: re.Match[str], language: Language) -> bool:
    following = next((char for char in text[match.end() : match.end() + 40] if char.isalnum()), "")
    if following.islower():
        # "e.g. this", "wait... what", "'Really?' she said"
        return False
    if match["mark"] != ".":
        return True
    return not is_abbreviation(text, match.start(), language.abbreviations, language.function_words)


def _bounded(text: str, start: int, end: int, limit: int) -> Iterator[TextStretch]:
    while end - start > limit:
        cut = _cut(text, start, start + limit)
        yield TextStretch(start, cut, False)
        start = cut
    if start < end:
        yield TextStretch(start, end, True)


def _cut(text: str, start: int, latest: int) -> int:
    """Return where to divide [start, latest): after a clause or blank in its second half, else at its end."""
    middle = (start + latest) // 2
    clauses = [match.end() for match in _CLAUSE_END.finditer(text, middle, latest)]
    if clauses:
        return clauses[-1]
    blanks = [at for at in range(middle, latest) if text[at].isspace()]
    if blanks:
        return blanks[-1] + 1
    while latest > middle + 1 and unicodedata.combining(text[latest]):
        latest -= 1
    return latest
