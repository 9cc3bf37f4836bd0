"""Check that a text can be spoken: a letter or digit, no control characters, not too much."""

from __future__ import annotations

import unicodedata

from ..errors import InputError, Place
from .quote import quoted

MAX_CHARACTERS = 100_000
_LAYOUT = frozenset("\t\n\r\f\v\x85")
_CONTROL, _SURROGATE = "Cc", "Cs"


def check_speakable(text: str, source: str, place: Place | None = None) -> None:
    """Raise InputError if `text` cannot be spoken; at `place`, else where the fault stands in `source`."""
    at = place or Place(source, 1)
    if not text.strip():
        raise InputError("the text is empty; expected words to speak", at)
    check_length(len(text), at)
    for index, character in enumerate(text):
        if unicodedata.category(character) in (_CONTROL, _SURROGATE) and character not in _LAYOUT:
            where = place or position(source, text, index)
            raise InputError(
                f"U+{ord(character):04X} is not a character of a text; expected plain words", where
            )
    if not any(c.isalnum() for c in text):
        raise InputError(f"nothing can be spoken in {quoted(text)}; expected a letter or digit", at)


def check_length(characters: int, place: Place) -> None:
    """Raise InputError if there are too many characters to speak."""
    if characters > MAX_CHARACTERS:
        raise InputError(
            f"the text has {characters:,} characters; expected at most {MAX_CHARACTERS:,}", place
        )


def position(source: str, text: str, index: int) -> Place:
    """Return the line and column, from 1, of the character at `index` of `text`."""
    line_start = text.rfind("\n", 0, index) + 1
    return Place(source, text.count("\n", 0, index) + 1, index - line_start + 1)
