"""A text as it is given to the speech engine, with the place in the source of every character.

Abbreviations, amounts of money and units are written out as the language reads them; signs that nobody reads
aloud (quotes, emoji, markup characters, invisible characters) are left out.
"""

from __future__ import annotations

import unicodedata
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

from ...core.directions import Break, DirectedSpan, Directions
from ...languages import Language
from ...languages.abbreviations import Replacement, written_out
from ...languages.language import APOSTROPHES
from .tokens import BREAKS

_QUOTES = '"\u201c\u201d\u201e\u201f\u00ab\u00bb\u2039\u203a\u2018'
_MARKUP = "[]{}<>*_~^`|\\\u2022\u2023\u25e6\u25aa\u00b7"
_SILENT = frozenset(_QUOTES + _MARKUP + BREAKS)
_SPOKEN = frozenset("°")
_SILENT_CATEGORIES = frozenset({"So", "Sk", "Cs", "Co", "Cn", "Cc", "Zs", "Zl", "Zp"})
_JOINERS = frozenset("\u200c\u200d")
_COMPATIBLE = ("<font>", "<wide>", "<narrow>", "<compat>")


class NormalisedText(NamedTuple):
    """Text for the engine; `origin[i]` is the source offset that character i comes from."""

    text: str
    origin: tuple[int, ...]


def normalise(
    text: str, start: int, end: int, language: Language, dictated: Sequence[Replacement] = ()
) -> NormalisedText:
    """Return the spoken form of characters [start, end) of `text`, without line breaks.

    `dictated`: stretches whose words are given, in order.
    """
    chars: list[str] = []
    origin: list[int] = []

    def put(piece: str, source: int) -> None:
        chars.append(piece)
        origin.extend([source] * len(piece))

    at = start
    for piece in replacements(text, start, end, language, dictated):
        _clean(text, at, piece.start, put)
        for read, source in piece.read:
            put(read, source)
        at = piece.end
    _clean(text, at, end, put)
    return NormalisedText("".join(chars), tuple(origin))


def replacements(
    text: str, start: int, end: int, language: Language, dictated: Sequence[Replacement] = ()
) -> Iterator[Replacement]:
    """Yield what of characters [start, end) of `text` is read otherwise than it is written, in order."""
    at = start
    for given in (*dictated, Replacement(end, end, ())):
        if given.start >= start and given.end <= end:
            yield from written_out(
                text, at, given.start, language.abbreviations, language.function_words, stop=end
            )
            at = given.end
            if given.start < given.end:
                yield given


def placed(
    directions: Directions, spoken: NormalisedText, start: int, end: int, *, last: bool = False
) -> Iterator[DirectedSpan | Break]:
    """Yield the `directions` for characters [start, end) of the source, by characters of `spoken`.

    `last`: no text follows, so that breaks at its end belong here.
    """
    for direction in directions.between(start, end, last=last):
        if isinstance(direction, Break):
            if direction.seconds > 0.0:
                yield replace(direction, at=bisect_left(spoken.origin, direction.at))
            continue
        if direction.spoken is not None:
            continue
        first, stop = (bisect_left(spoken.origin, at) for at in (direction.start, direction.end))
        if first < stop:
            yield replace(direction, start=first, end=stop)


def _clean(text: str, start: int, end: int, put: Callable[[str, int], None]) -> None:
    at = start
    while at < end:
        stop = at + 1
        while stop < end and unicodedata.combining(text[stop]):
            stop += 1
        cluster = unicodedata.normalize("NFC", text[at:stop])
        for char in cluster:
            put(_cleaned(text, at, char), at)
        at = stop


def _cleaned(text: str, at: int, char: str) -> str:
    """Return the spoken form of `char`, a blank if it only separates, nothing if it is invisible."""
    if char in APOSTROPHES:
        inside = at > 0 and text[at - 1].isalnum() and text[at + 1 : at + 2].isalnum()
        return "'" if inside else " "
    category = unicodedata.category(char)
    if char in _SILENT or (category in _SILENT_CATEGORIES and char not in _SPOKEN):
        return " "
    if category == "Cf" or "\ufe00" <= char <= "\ufe0f" or category == "Me":
        # Joiners shape words in Persian and the scripts of India; elsewhere they join emoji.
        return char if char in _JOINERS and at > 0 and text[at - 1].isalpha() else ""
    if char.isalpha() and unicodedata.decomposition(char).startswith(_COMPATIBLE):
        return unicodedata.normalize("NFKC", char)
    return char
