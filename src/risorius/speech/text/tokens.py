"""Words of a text, as a reader counts them, with their places.

A token is a run of letters and digits with what is spoken or written as one with it: "it's", "must-have",
"$5.50", "3:45", "20°C", "example.com". Quotes, brackets and the punctuation around it are not part of it.
Chinese characters and Japanese kana, which stand without spaces, are tokens one by one; `with_words` joins
those of known words.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence, Set
from itertools import takewhile
from typing import NamedTuple

from ...core.speech.characters import stands_alone
from ...languages.language import APOSTROPHES

HYPHENS = "-\u2010\u2011"
# Characters without width that separate words: zero width space, byte order mark.
BREAKS = "\u200b\ufeff"

_BODY = r"[wd][wdj]*"
# Within a token: one sign between two letters or digits; comma and colon between digits only.
_JOINED = rf"(?:['\-.&/@+_=]|(?<=d)[,:](?=d)){_BODY}"
_TOKEN = re.compile(rf"c|(?:(?<![wdj])[\-+](?=[$d]))?[$#@]*{_BODY}(?:{_JOINED})*[%°+#]*[wd]*|[&@%+=$#°]+")
_CLASSES = {
    **dict.fromkeys(APOSTROPHES, "'"),
    **dict.fromkeys(HYPHENS + "\u2212", "-"),
    **{char: char for char in ".,:&/@+_=%°#"},
}


class Token(NamedTuple):
    """Characters [start, end) of a text."""

    text: str
    start: int
    end: int


def tokenize(text: str) -> tuple[Token, ...]:
    """Return the tokens of `text` in order; `text[token.start:token.end] == token.text`."""
    classes = "".join(map(_character_class, text))
    return tuple(Token(text[m.start() : m.end()], m.start(), m.end()) for m in _TOKEN.finditer(classes))


def with_words(tokens: Sequence[Token], words: Set[str]) -> tuple[Token, ...]:
    """Return the tokens, those without spaces between them joined to `words`, the longest first."""
    if not words:
        return tuple(tokens)
    longest = max(map(len, words))
    joined: list[Token] = []
    at = 0
    while at < len(tokens):
        run = [tokens[at], *takewhile(_stands_by_itself, tokens[at + 1 : at + longest])]
        counts = range(len(run) if _stands_by_itself(run[0]) else 1, 1, -1)
        count = next((n for n in counts if _is_word(run[:n], words)), 1)
        joined.append(Token("".join(t.text for t in run[:count]), run[0].start, run[count - 1].end))
        at += count
    return tuple(joined)


def _stands_by_itself(token: Token) -> bool:
    return len(token.text) == 1 and stands_alone(token.text)


def _is_word(tokens: Sequence[Token], words: Set[str]) -> bool:
    touching = tokens[-1].end - tokens[0].start == len(tokens)
    return touching and "".join(token.text for token in tokens) in words


def is_speakable(text: str) -> bool:
    """Tell whether anything in `text` is read aloud."""
    return any(_character_class(char) in "wdc$%&+=@°#" for char in text)


def _character_class(char: str) -> str:
    """Return one character: w letter, d digit, j joined to the one before it, c one that stands without
    spaces, $ currency, a blank, or the sign itself.
    """
    if char in _CLASSES:
        return _CLASSES[char]
    if stands_alone(char):
        return "c"
    if char.isdecimal():
        return "d"
    category = unicodedata.category(char)
    if category[0] == "M" or (category == "Cf" and char not in BREAKS):
        return "j"
    if char.isalnum():
        return "w"
    return "$" if category == "Sc" else " "
