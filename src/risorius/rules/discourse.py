"""Properties of speech beyond its sentences: turns, groups of related sentences, rates of phrases."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from ..core.speech.utterance import Phrase, Utterance
from .synchrony import synchrony


@dataclass(frozen=True, slots=True)
class Turn:
    """Words [first_word, last_word) that the speaker says without listening between. Seconds."""

    first_word: int
    last_word: int
    start: float
    end: float


def turns_of(utterance: Utterance, listening: Sequence[tuple[float, float]]) -> tuple[Turn, ...]:
    """Return the turns, in order; `listening`: spans of seconds in which they end."""
    words = utterance.words
    gaps = enumerate(pairwise(words), 1)
    cuts = [
        first
        for first, (before, after) in gaps
        if any(start < after.start and before.end < end for start, end in listening)
    ]
    return tuple(
        Turn(first, last, words[first].start, words[last - 1].end)
        for first, last in pairwise([0, *cuts, len(words)])
    )


def groups_of(utterance: Utterance) -> Iterator[int]:
    """Yield the group of each sentence: a long silence or a new line begins another subject."""
    group = 0
    yield group
    words = utterance.words
    for before, after in pairwise(utterance.sentences):
        between = utterance.text[
            words[before.last_word - 1].source_end : words[after.first_word].source_start
        ]
        group += "\n" in between or after.start - before.end > synchrony().group_pause
        yield group


def rate_of_phrase(utterance: Utterance, phrase: Phrase) -> float:
    """Return the syllables a second of a phrase, its pauses left out; the usual rate without any."""
    first, last = (
        bisect_left(utterance.syllables, word, key=lambda s: s.word)
        for word in (phrase.first_word, phrase.last_word)
    )
    inside = slice(
        bisect_left(utterance.pauses, phrase.start, key=lambda p: p.start),
        bisect_left(utterance.pauses, phrase.end, key=lambda p: p.start),
    )
    seconds = phrase.end - phrase.start - sum(p.end - p.start for p in utterance.pauses[inside])
    return (last - first) / seconds if last > first else synchrony().usual_rate
