"""Words as they are written: with the marks that stand around them in the text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from .utterance import Utterance, Word


def written_words(utterance: Utterance) -> list[str]:
    """Return the words with the marks that follow each in the text, as they are if they are not found."""
    starts = list(_starts(utterance.text, utterance.words))
    if len(starts) < len(utterance.words):
        return [word.text for word in utterance.words]
    edges = pairwise([*starts, len(utterance.text)])
    return [utterance.text[start:end].strip() for start, end in edges]


def _starts(text: str, words: Sequence[Word]) -> Iterator[int]:
    at, lowered = 0, text.lower()
    for number, word in enumerate(words):
        start = lowered.find(word.text.lower(), at)
        if start < 0:
            return
        end = start + len(word.text)
        while start > at and not text[start - 1].isspace():
            start -= 1  # what opens before a word, as a quotation mark
        yield start if number else 0
        at = end
