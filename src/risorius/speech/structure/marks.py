"""The times of the places that a script names: SSML's `mark` and BML's `sync`."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import replace

from ...core.directions import Sync
from ...core.speech.utterance import NamedTime, Utterance, Word
from .lines import TextLine


def with_marks(utterance: Utterance, lines: Sequence[TextLine]) -> Utterance:
    """Return the utterance with the times of the named places of its lines."""
    marks = tuple(_timed(utterance, lines))
    return replace(utterance, marks=marks) if marks else utterance


def _timed(utterance: Utterance, lines: Sequence[TextLine]) -> Iterator[NamedTime]:
    for line in lines:
        spoken = line.words(utterance.words)
        words = utterance.words[spoken.start : spoken.stop]
        for sync in line.directions.syncs if words else ():
            yield NamedTime(sync.name, _time(sync, words))


def _time(sync: Sync, words: Sequence[Word]) -> float:
    """Return when the word after a place starts, or when the one before it ends if none follows."""
    following = bisect_left(words, sync.at, key=lambda word: word.source_start)
    if sync.ends or following == len(words):
        return words[following - 1].end if following else words[0].start
    return words[following].start
