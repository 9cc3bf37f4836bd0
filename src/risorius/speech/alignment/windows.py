"""Long recordings, some half a minute at a time, so that memory does not grow with their length.

Each window hears more than it keeps: as many of the next words are followed as are said in it, and it ends in
the longest pause between two words of its later part, with the words before that pause.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from ..resampled import Resampled
from .decoder import Decoders, Readings

# Seconds. Sound of at most the first length is one window.
WHOLE, HEARD, EARLIEST, LATEST = 36.0, 30.0, 10.0, 25.0
# Words per second that nobody exceeds for so long.
FASTEST = 5.5


class Window(NamedTuple):
    """The words [first, last) are said in [start, end) seconds."""

    start: float
    end: float
    first: int
    last: int


def windows(resampled: Resampled, words: Sequence[Readings], decoders: Decoders) -> Iterator[Window]:
    """Yield windows that follow one another over the recording and all words."""
    start, first = 0.0, 0
    duration = resampled.audio.duration
    while duration - start > WHOLE:
        heard = resampled.read(start, start + HEARD)
        ahead = words[first : first + round(HEARD * FASTEST)]
        spans = decoders.follow_words(heard, ahead) if ahead else []
        count, length = _cut(spans) if first + len(spans) < len(words) else (len(spans), HEARD)
        yield Window(start, start + length, first, first + count)
        start, first = start + length, first + count
    yield Window(start, duration, first, len(words))


def _cut(spans: Sequence[tuple[float, float]]) -> tuple[int, float]:
    """Return how many of the words to keep, and after how many seconds to cut."""
    gaps = [(b[0] - a[1], 0.5 * (a[1] + b[0]), count) for count, (a, b) in enumerate(pairwise(spans), 1)]
    late = [gap for gap in gaps if EARLIEST <= gap[1] <= LATEST]
    if late:
        _, at, count = max(late)
        return count, at
    if gaps and gaps[-1][1] > LATEST:
        # One endless word: the first edge after it.
        _, at, count = next(gap for gap in gaps if gap[1] > LATEST)
        return count, at
    # Hardly anything is said: the last word may be cut off and is left to the next window.
    return (gaps[-1][2], gaps[-1][1]) if gaps else (0, EARLIEST)
