"""Exact times of phones: closures of stops, short silences, and sounds without a duration of their own.

Everything here counts samples, and the segments stay contiguous throughout.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from ...core.speech.utterance import SILENCE

# A stop's closure leaves the phone before it at least this much (seconds) and this share.
KEPT_SECONDS = 0.020
KEPT_SHARE = 0.4
# Silence that no punctuation asks for is a pause from here on; below, it belongs to the sound before it.
SHORTEST_PAUSE = 0.060
# A sound that the engine merged into its neighbour gets this long (seconds), but no more than this share.
LENT_SECONDS = 0.050
LENT_SHARE = 0.35
SHORTEST_PHONE = 0.010

NO_TOKEN = -1


@dataclass(slots=True)
class Segment:
    """A phone or silence [start, end) in samples, of the token with index `token`.

    `closure`: by how many samples a stop's closure precedes `start`. `intended`: a silence that punctuation
    asks for.
    """

    symbol: str
    start: int
    end: int
    stress: int = -1
    closure: int = 0
    token: int = NO_TOKEN
    intended: bool = False
    tone: str = ""

    @property
    def length(self) -> int:
        """Samples."""
        return self.end - self.start

    @property
    def silent(self) -> bool:
        """Tell whether this is silence."""
        return self.symbol == SILENCE


def settle(segments: list[Segment], sample_rate: int) -> list[Segment]:
    """Return the segments with all times mended; they cover the same span without a gap."""
    settled = _join_silences(segments)
    _close_stops(settled, sample_rate)
    settled = _absorb_silences(settled, sample_rate)
    _lend_time(settled, sample_rate)
    return [segment for segment in settled if segment.length > 0]


def _join_silences(segments: list[Segment]) -> list[Segment]:
    joined: list[Segment] = []
    for segment in segments:
        if segment.silent and joined and joined[-1].silent:
            joined[-1].end = segment.end
            joined[-1].intended |= segment.intended
        else:
            joined.append(segment)
    return joined


def _close_stops(segments: list[Segment], sample_rate: int) -> None:
    for before, stop in pairwise(segments):
        if before.silent:
            room = before.length
        else:
            remaining = max(before.length * KEPT_SHARE, KEPT_SECONDS * sample_rate)
            room = before.length - math.ceil(remaining)
        moved = max(0, min(stop.closure, room))
        before.end -= moved
        stop.start -= moved


def _absorb_silences(segments: list[Segment], sample_rate: int) -> list[Segment]:
    settled: list[Segment] = []
    # Samples at the beginning that fall to the first sound.
    early = 0
    for segment in segments:
        short = segment.length < round((SHORTEST_PHONE if segment.intended else SHORTEST_PAUSE) * sample_rate)
        if segment.silent and short:
            if settled:
                settled[-1].end = segment.end
            else:
                early = segment.length
            continue
        segment.start -= early
        early = 0
        settled.append(segment)
    return settled or segments


def _lend_time(segments: list[Segment], sample_rate: int) -> None:
    for index, segment in enumerate(segments):
        if segment.length >= round(SHORTEST_PHONE * sample_rate):
            continue
        before = segments[index - 1] if index else None
        after = segments[index + 1] if index + 1 < len(segments) else None
        lender = max((s for s in (before, after) if s is not None), key=lambda s: s.length, default=None)
        if lender is None:
            continue
        lent = min(round(LENT_SECONDS * sample_rate) - segment.length, int(lender.length * LENT_SHARE))
        if lender is before:
            before.end -= lent
            segment.start -= lent
        else:
            lender.start += lent
            segment.end += lent
