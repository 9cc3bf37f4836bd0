"""Speech brought to the times that its script gives for every phone and pause (paper B, section 5.1)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...core.directions import DirectedSpan, Directions
from ...core.speech.audio import Samples
from ...core.speech.utterance import SILENCE
from ...languages import phonesets
from ..engines.mnemonics import to_arpabet
from ..text.tokens import Token
from .stretch import stretch
from .timing import NO_TOKEN, Segment

_STRESS = {"0": 0, "1": 2, "2": 1}


class _Piece(NamedTuple):
    """A silence or a word: its segments with their new lengths, and the edges of those it had; in samples."""

    edges: tuple[int, ...]
    token: int
    segments: tuple[tuple[Segment, int], ...]

    @property
    def length(self) -> int:
        return sum(length for _, length in self.segments)


def is_timed(directions: Directions) -> bool:
    """Tell whether any phone has a duration of its own."""
    return any(span.seconds for span in directions.spans)


def retime(
    samples: Samples,
    segments: Sequence[Segment],
    tokens: Sequence[Token],
    directions: Directions,
    sample_rate: int,
) -> tuple[Samples, list[Segment]]:
    """Return the speech with the durations of `directions`; words without any keep theirs.

    The sound is that of the segments alone. Between two words that have durations, only the breaks given are
    silent.
    """
    first = segments[0].start
    pieces = list(_pieces(segments, tokens, directions, sample_rate))
    sound = [_sound(piece, samples, first, sample_rate) for piece in pieces]
    return np.concatenate(sound), _moved(pieces, first)


def _pieces(
    segments: Sequence[Segment], tokens: Sequence[Token], directions: Directions, rate: int
) -> Iterator[_Piece]:
    spans = [_span_of(token, directions) for token in tokens]
    stops = {segment.token: index + 1 for index, segment in enumerate(segments)}
    index = 0
    while index < len(segments):
        segment = segments[index]
        stop = index + 1 if segment.silent else stops[segment.token]
        inside = segments[index:stop]
        edges = (segment.start, *(s.end for s in inside))
        span = None if segment.silent else spans[segment.token]
        if span is not None:
            yield _Piece(edges, segment.token, tuple(_dictated(span, segment.token, rate)))
        elif segment.silent:
            length = _silence(segments, index, tokens, spans, directions, rate)
            yield _Piece(edges, NO_TOKEN, ((segment, length),))
        else:
            yield _Piece(edges, segment.token, tuple((s, s.length) for s in inside))
        index = stop
        before, after = segments[stop - 1].token, segments[stop].token if stop < len(segments) else NO_TOKEN
        if NO_TOKEN not in (before, after) and spans[before] and spans[after]:
            seconds = _breaks(tokens[before], tokens[after], directions)
            if seconds:
                yield _Piece(edges[-1:], NO_TOKEN, ((Segment(SILENCE, 0, 0), round(seconds * rate)),))


def _span_of(token: Token, directions: Directions) -> DirectedSpan | None:
    return next((s for s in directions.spans if s.seconds and s.start <= token.start < s.end), None)


def dictated_phones(span: DirectedSpan) -> Iterator[tuple[str, int, float]]:
    """Yield symbol, stress and seconds of each phone that is written for a word with durations."""
    for written, seconds in zip(span.phones, span.seconds, strict=True):
        (phone,) = to_arpabet(written)
        vowel = phone[:-1] in phonesets.VOWELS
        yield phone[:-1] if vowel else phone, _STRESS[phone[-1]] if vowel else -1, seconds


def _dictated(span: DirectedSpan, token: int, rate: int) -> Iterator[tuple[Segment, int]]:
    for symbol, stress, seconds in dictated_phones(span):
        yield Segment(symbol, 0, 0, stress, token=token), round(seconds * rate)


def _silence(
    segments: Sequence[Segment],
    index: int,
    tokens: Sequence[Token],
    spans: Sequence[DirectedSpan | None],
    directions: Directions,
    rate: int,
) -> int:
    """Return how many samples a silence lasts: its own length, or that of the breaks between timed words."""
    before = segments[index - 1].token if index else NO_TOKEN
    after = segments[index + 1].token if index + 1 < len(segments) else NO_TOKEN
    if NO_TOKEN in (before, after) or not (spans[before] and spans[after]):
        return segments[index].length
    return round(_breaks(tokens[before], tokens[after], directions) * rate)


def _breaks(before: Token, after: Token, directions: Directions) -> float:
    return sum(b.seconds for b in directions.breaks if before.end <= b.at <= after.start)


def _sound(piece: _Piece, samples: Samples, first: int, rate: int) -> Samples:
    """Return the sound of a piece; `samples` begin at the sample `first` of the whole."""
    if piece.token == NO_TOKEN:
        return np.zeros(piece.length, np.int16)
    source = np.array(piece.edges, dtype=np.float64) - first
    target = np.cumsum([0.0, *(length for _, length in piece.segments)])
    if len(source) != len(target):
        # Phones that the voice made more or fewer of: only the word's ends are sure.
        source, target = source[[0, -1]], target[[0, -1]]
    if np.array_equal(source - source[0], target):
        return samples[piece.edges[0] - first : piece.edges[-1] - first]
    return stretch(samples, source, target, rate)


def _moved(pieces: Sequence[_Piece], first: int) -> list[Segment]:
    """Return the segments at their new times, from the sample `first` on."""
    moved: list[Segment] = []
    at = first
    for segment, length in (pair for piece in pieces for pair in piece.segments):
        if length:
            moved.append(replace(segment, start=at, end=at + length))
            at += length
    return moved
