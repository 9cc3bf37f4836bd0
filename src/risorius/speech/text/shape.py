"""Words of a text of which parts are said otherwise than written: each part is a word, or several."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from ...core.directions import Break, Directions
from ...core.speech.characters import stands_alone
from ...languages import Language
from ...languages.abbreviations import Replacement
from ...languages.load import folder_of
from ...languages.spoken_forms import read_otherwise
from .tokens import BREAKS, Token, tokenize, with_words

_PAUSES = frozenset(".,;:!?\u2026\u2013\u2014()\u3001\u3002\uff0c\uff01\uff1f\uff1b\uff1a")
# A character that is a word by itself, and one that is part of none.
_ALONE, _NOTHING = "\u3400", BREAKS[0]
_AROUND = " \u00a0,.;:-"


@dataclass(frozen=True, slots=True)
class WordedText:
    """A text with its words: `dictated` parts are said otherwise, and are plain letters in `shape`."""

    text: str
    shape: str
    tokens: tuple[Token, ...]
    dictated: tuple[Replacement, ...]


def worded(text: str, directions: Directions, language: Language, variant: str) -> WordedText:
    """Return a text with its words; `variant` is the voice's language (BCP 47)."""
    text = without_pauses(text, directions.breaks)
    dictated = _dictated(text, directions, variant)
    if not dictated:
        return WordedText(text, text, with_words(tokenize(text), language.words), ())
    parts: list[tuple[int, int]] = []
    shape = list(text)
    for piece in dictated:
        for start, stop, end, said in _words(piece, text):
            parts.append((start, stop))
            shape[start:stop] = _letters(text[start:stop])
            if not said.endswith("."):
                # A full stop that is not said ends no sentence.
                shape[stop:end] = text[stop:end].replace(".", _NOTHING).replace("-", _NOTHING)
    shaped = "".join(shape)
    ends = dict(parts)
    tokens = tuple(
        Token(text[t.start : end], t.start, end)
        for t in with_words(tokenize(shaped), language.words)
        for end in (max(t.end, ends.get(t.start, t.end)),)
    )
    return WordedText(text, shaped, tokens, dictated)


def _dictated(text: str, directions: Directions, variant: str) -> tuple[Replacement, ...]:
    """Return what is said otherwise: as the directions ask, else as the language does."""
    asked = sorted((s for s in directions.spans if s.spoken is not None), key=lambda span: span.start)
    fixed = [(s.start, s.end) for s in directions.spans if s.spoken is not None or s.phones]
    found = [
        piece
        for piece in read_otherwise(text, variant)
        if not any(start < piece.end and piece.start < end for start, end in fixed)
    ]
    for span in directions.spans:
        if span.language and folder_of(span.language) == "ja":
            read = read_otherwise(text[span.start : span.end], span.language)
            found += [_moved(piece, span.start) for piece in read]
    chosen: list[Replacement] = []
    for span in asked:
        if not chosen or span.start >= chosen[-1].end:
            said = ((_said(span.spoken or "", variant), span.start),)
            chosen.append(Replacement(span.start, span.end, said, joined=True))
    return tuple(sorted([*chosen, *found]))


def _moved(piece: Replacement, by: int) -> Replacement:
    read = tuple((said, at + by) for said, at in piece.read)
    return Replacement(piece.start + by, piece.end + by, read, piece.joined)


def _said(words: str, variant: str) -> str:
    """Return words with their dates, times and the like as the language says them."""
    for piece in reversed(read_otherwise(words, variant)):
        words = words[: piece.start] + "".join(said for said, _ in piece.read) + words[piece.end :]
    return words


def _words(piece: Replacement, text: str) -> Iterator[tuple[int, int, int, str]]:
    """Yield where each word of a piece begins and ends, where the next one begins, and what is said."""
    starts = [source for _, source in piece.read]
    for (said, start), end in zip(piece.read, [*starts[1:], piece.end], strict=True):
        stop = end
        while stop > start + 1 and text[stop - 1] in _AROUND:
            stop -= 1
        if start < end:
            yield start, stop, end, said


def _letters(written: str) -> str:
    """Return letters, or digits, in place of a word, by which it is one word; a sign stands alone."""
    if stands_alone(written[0]):
        return _ALONE + _NOTHING * (len(written) - 1)
    if written[0].isdigit():
        return "0" * len(written)
    if any(char.isalnum() for char in written):
        return ("X" if written[0].isupper() else "x") + "x" * (len(written) - 1)
    return _ALONE + _NOTHING * (len(written) - 1)


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
