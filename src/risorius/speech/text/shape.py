"""The text in which words and sentences are found: each character at its place, some replaced."""

from __future__ import annotations

from collections.abc import Iterable

from ...core.directions import Break
from ...languages.abbreviations import Replacement

_LETTER = "x"
_PAUSES = frozenset(".,;:!?\u2026\u2013\u2014()\u3001\u3002\uff0c\uff01\uff1f\uff1b\uff1a")


def one_word_each(text: str, replacements: Iterable[Replacement]) -> str:
    """Return `text` with letters for each stretch that is read otherwise, so that it is one word."""
    for piece in replacements:
        text = text[: piece.start] + _LETTER * (piece.end - piece.start) + text[piece.end :]
    return text


def without_pauses(text: str, breaks: Iterable[Break]) -> str:
    """Return `text` with blanks for the punctuation at breaks of no length, where no pause is made."""
    for join in breaks:
        if join.seconds == 0.0:
            start, end = join.at, join.at
            while start > 0 and _pauses(text, start - 1):
                start -= 1
            while end < len(text) and _pauses(text, end):
                end += 1
            if start > 0 and end < len(text):
                text = text[:start] + " " * (end - start) + text[end:]
    return text


def _pauses(text: str, at: int) -> bool:
    character = text[at]
    if character == "-":
        return text[at - 1 : at].isspace() and text[at + 1 : at + 2].isspace()
    return character.isspace() or character in _PAUSES
