"""The nucleus of a phrase: its last accent."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import zip_longest

from ...core.speech.utterance import Accent


def with_nuclei(accents: Sequence[Accent], last_words: Collection[int]) -> tuple[Accent, ...]:
    """Return the accents, in order, with the last of each phrase marked as nuclear.

    `last_words`: the words with which phrases end; the last accent of all is nuclear in any case.
    """
    ends = sorted(last_words)
    phrases = [bisect_left(ends, accent.word) for accent in accents]
    return tuple(
        replace(accent, nuclear=phrase != following)
        for accent, phrase, following in zip_longest(accents, phrases, phrases[1:])
    )
