"""Runs: stretches of speech between two pauses. Each is measured from the sound up to its end."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import dataclass

from ...core.speech.utterance import Utterance


@dataclass(frozen=True, slots=True)
class Run:
    """Words and syllables without a pause between them, in [start, end] seconds."""

    words: range
    syllables: range
    start: float
    end: float


def runs_of(utterance: Utterance) -> Iterator[Run]:
    """Yield the runs of an utterance, in order."""
    first = 0
    words = utterance.words
    for index in range(len(words)):
        if index + 1 == len(words) or utterance.pause_after(index) is not None:
            inside = range(first, index + 1)
            low, high = (
                bisect_left(utterance.syllables, w, key=lambda s: s.word) for w in (first, index + 1)
            )
            yield Run(inside, range(low, high), words[first].start, words[index].end)
            first = index + 1
