"""Words as they are written: with the marks that stand around them in the text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from .characters import shown
from .utterance import Utterance, Word

# What ends a word or a sentence in scripts without blanks.
_CLOSING = frozenset(
    "\u3001\u3002\uff0c\uff0e\uff01\uff1f\uff1b\uff1a\uff09\u300d\u300f\u3011\u300b\u2026\u201d\u2019"
)


def written_parts(utterance: Utterance) -> list[str]:
    """Return the parts of the text that belong to each word, with the blanks after them."""
    starts = list(_starts(utterance.text, utterance.words))
    if len(starts) < len(utterance.words):
        return [word.text for word in utterance.words]
    edges = pairwise([*starts, len(utterance.text)])
    return [shown(utterance.text[start:end]) for start, end in edges]


def written_words(utterance: Utterance) -> list[str]:
    """Return the words with the marks that follow each in the text, as they are if they are not found.

    What is hidden in the text is left out.
    """
    return [part.strip() for part in written_parts(utterance)]


def _starts(text: str, words: Sequence[Word]) -> Iterator[int]:
    at, lowered = 0, text.lower()
    for number, word in enumerate(words):
        start = lowered.find(word.text.lower(), at)
        if start < 0:
            return
        end = start + len(word.text)
        while start > at and not text[start - 1].isspace() and text[start - 1] not in _CLOSING:
            start -= 1  # what opens before a word, as a quotation mark
        yield start if number else 0
        at = end
