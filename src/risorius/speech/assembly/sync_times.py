"""Speech brought to the times that its script gives for places in the text (`<sync time="…"/>` of BML).

Two places in a row between two words are the end of the first and the start of the second. One place alone is
the start of the word after it: what is spoken before it becomes faster, a little slower, or is followed by
silence. After the last word it is that word's end.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import NamedTuple

import numpy as np

from ...core.directions import Directions, Sync
from ...core.speech.audio import Samples
from ...core.speech.utterance import SILENCE
from ...errors import SpeechWarning, warn
from ...script.quote import quoted
from ..text.tokens import Token
from .stretch import stretch
from .timing import NO_TOKEN, Segment

# How many times as long words may become, and how much longer before silence follows them instead.
FASTEST, SLOWEST, SLOWER = 0.4, 4.0, 1.3


class _Knot(NamedTuple):
    """A moment of the speech, and when it is to be; in samples from the line's start."""

    source: int
    target: int


def has_times(directions: Directions) -> bool:
    """Tell whether any place in the text has a time."""
    return any(sync.seconds is not None for sync in directions.syncs)


def at_sync_times(
    samples: Samples,
    segments: Sequence[Segment],
    tokens: Sequence[Token],
    directions: Directions,
    rate: int,
) -> tuple[Samples, list[Segment]]:
    """Return the speech with its places at their times, in seconds from its start.

    Warns (SpeechWarning) of a place that stays where it is: inside a word, not after the one before it, or
    with words that would be too fast or too slow.
    """
    first = segments[0].start
    knots = list(_knots(segments, tokens, directions, rate))
    moved: list[Segment] = []
    sound: list[Samples] = []
    at = first
    for _, group in groupby(segments, key=lambda segment: segment.token):
        inside = list(group)
        source = np.array([inside[0].start, *(segment.end for segment in inside)]) - first
        target = [_later(knots, int(source[0])), *(_earlier(knots, int(edge)) for edge in source[1:])]
        target = np.maximum.accumulate(target).tolist()
        if first + target[0] > at:
            moved.append(Segment(SILENCE, at, first + target[0], intended=True))
            sound.append(np.zeros(first + target[0] - at, np.int16))
        sound.append(_sound(samples[source[0] : source[-1]], source, np.array(target), inside[0].token, rate))
        for segment, start, end in zip(inside, target, target[1:], strict=False):
            if end > start:
                moved.append(replace(segment, start=first + start, end=first + end))
        at = first + target[-1]
    return np.concatenate(sound), moved


def _sound(samples: Samples, source: np.ndarray, target: np.ndarray, token: int, rate: int) -> Samples:
    length = int(target[-1] - target[0])
    if length == len(samples) and np.array_equal(np.diff(source), np.diff(target)):
        return samples
    if token == NO_TOKEN:
        return np.pad(samples[:length], (0, max(length - len(samples), 0)))
    return stretch(samples, source - source[0].astype(np.float64), target.astype(np.float64), rate)


def _knots(
    segments: Sequence[Segment], tokens: Sequence[Token], directions: Directions, rate: int
) -> Iterator[_Knot]:
    """Yield the knots of speech in order: its start, and each place that can be at its time."""
    first = segments[0].start
    starts: dict[int, int] = {}
    ends: dict[int, int] = {}
    for segment in segments:
        if segment.token != NO_TOKEN:
            starts.setdefault(segment.token, segment.start - first)
            ends[segment.token] = segment.end - first
    spoken = sorted(starts)
    before = _Knot(0, 0)
    yield before
    for gap, syncs in _gaps(directions.syncs, [tokens[token] for token in spoken]):
        wanted = [(sync, round((sync.seconds or 0.0) * rate)) for sync in syncs]
        end = ends[spoken[gap - 1]] if gap else 0
        start = starts[spoken[gap]] if gap < len(spoken) else None
        for knot, sync in _of_gap(before, wanted, end if gap else None, start):
            ends_word = knot.source == end and knot.source != before.source
            fault = _fault(before, knot, spoken=ends_word)
            if fault:
                _tell(sync, fault)
                if not ends_word:
                    continue
                knot = _Knot(end, before.target + end - before.source)  # as it is spoken
            before = knot
            yield knot


def _gaps(syncs: Sequence[Sync], tokens: Sequence[Token]) -> Iterator[tuple[int, list[Sync]]]:
    """Yield the number of words before each gap between words that has timed places, and these in order."""
    timed: list[tuple[int, Sync]] = []
    for sync in syncs:
        if sync.seconds is None:
            continue
        if any(token.start < sync.at < token.end for token in tokens):
            _tell(sync, "it is inside a word")
            continue
        timed.append((sum(token.end <= sync.at for token in tokens), sync))
    for gap, group in groupby(timed, key=lambda pair: pair[0]):
        yield gap, [sync for _, sync in group]


def _of_gap(
    before: _Knot, wanted: Sequence[tuple[Sync, int]], end: int | None, start: int | None
) -> Iterator[tuple[_Knot, Sync]]:
    """Yield the knots of the gap between a word's `end` and the next one's `start`, None at the ends."""
    (opening, earliest), (closing, latest) = wanted[0], wanted[-1]
    if end is not None and (len(wanted) > 1 or start is None):
        yield _Knot(end, earliest), opening
    elif end is not None and start is not None:
        natural = before.target + end - before.source
        if latest - before.target > SLOWER * (start - before.source) and latest > natural:
            yield _Knot(end, natural), closing
    if start is not None:
        yield _Knot(start, latest), closing


def _fault(before: _Knot, knot: _Knot, *, spoken: bool) -> str:
    """Return why a knot cannot follow another, nothing if it can; `spoken`: a word ends there."""
    source, target = knot.source - before.source, knot.target - before.target
    if target < 0:
        return "it is not after the one before it"
    if source and target < FASTEST * source:
        return f"the words before it would be {source / max(target, 1):.1f} times as fast"
    if spoken and source and target > SLOWEST * source:
        return f"the words before it would be {target / source:.1f} times as slow"
    return ""


def _tell(sync: Sync, reason: str) -> None:
    warn(
        f"{sync.place}: sync point {quoted(sync.name)} is not at {sync.seconds:g} s: {reason}", SpeechWarning
    )


def _later(knots: Sequence[_Knot], source: int) -> int:
    """Return when a moment is at last, as the start of what follows it."""
    return _at(knots, source, max(k for k, knot in enumerate(knots) if knot.source <= source))


def _earlier(knots: Sequence[_Knot], source: int) -> int:
    """Return when a moment is first, as the end of what precedes it."""
    return _at(knots, source, max((k for k, knot in enumerate(knots) if knot.source < source), default=0))


def _at(knots: Sequence[_Knot], source: int, index: int) -> int:
    knot = knots[index]
    if index + 1 == len(knots):
        return knot.target + source - knot.source
    after = knots[index + 1]
    share = (source - knot.source) / max(after.source - knot.source, 1)
    return round(knot.target + share * (after.target - knot.target))
