"""Words as they are written: with the marks that stand around them in the text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from .characters import shown
from .utterance import Utterance, Word


def written_words(utterance: Utterance) -> list[str]:
    """Return the words with the marks that follow each in the text, as they are if they are not found.

    What is hidden in the text is left out.
    """
    starts = list(_starts(utterance.text, utterance.words))
    if len(starts) < len(utterance.words):
        return [word.text for word in utterance.words]
    edges = pairwise([*starts, len(utterance.text)])
    return [shown(utterance.text[start:end]).strip() for start, end in edges]


def _starts(text: str, words: Sequence[Word]) -> Iterator[int]:
    at, lowered = 0, text.lower()
    for number, word in enumerate(words):
        found = lowered.find(word.text.lower(), at)
        if found < 0:
            return
        end = found + len(word.text)
        while found > at and not text[found - 1].isspace():
            found -= 1  # what opens before a word, as a quotation mark
        yield found if number else 0
        at = end
