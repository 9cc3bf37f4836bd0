"""Pauses slow the head down: its movements begin, rise and fall in speech, and are held through pauses.

Paper B, section 5.2, after Hadar et al. 1983: rapid movements occur on accents, pauses slow them down.
"""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from ..core.speech.utterance import SENTENCE_ENDS, Utterance
from ..core.time import TICK
from .synchrony import MovementPhases, synchrony

# A fall that has this share of its time before a pause is over when it begins, else it waits for its end.
_MOST_OF = 0.7

# Seconds of a pause for whose end a movement waits that is not of the words.
_SHORT = 1.0


class StillTime(NamedTuple):
    """A pause, seconds [start, end). `ends`: no movement is held through it, because a sentence ends."""

    start: float
    end: float
    ends: bool


def still_times(said: Utterance) -> tuple[StillTime, ...]:
    """Return the pauses of an utterance in order; the time after the last word is always one."""
    found = [StillTime(p.start, p.end, p.kind in SENTENCE_ENDS) for p in said.pauses]
    if said.words and (not found or found[-1].start < said.words[-1].end):
        found.append(StillTime(said.words[-1].end, said.duration, ends=True))
    return tuple(found)


def begun_in_speech(span: MovementPhases, lead: float, pauses: Sequence[StillTime]) -> MovementPhases:
    """Return a span that begins no sooner than the last pause before its anchor ends.

    `lead`: how many seconds before its anchor it begins.
    """
    index = bisect_right(pauses, max(span.start, span.start + lead), key=lambda p: p.start) - 1
    if index < 0 or pauses[index].end <= span.start:
        return span
    return _later(span, pauses[index].end - span.start)


def between_pauses(
    span: MovementPhases, pauses: Sequence[StillTime], latest: float | None = None
) -> MovementPhases:
    """Return a span that rises and falls in speech, and is held through the pauses between.

    A rise or a fall that meets a pause is over when it begins, or waits for its end if that leaves it too
    little time (`least_time`). Before the end of a sentence all is over. `latest`: when the movement must
    have ended.
    """
    least = synchrony().least_time
    pause = _met(pauses, span.start, span.end)
    if pause is not None and pause.ends:
        return _ended(span, pause.start)
    span = _risen(span, pauses, least)
    offset, free = span.end - span.release, span.apex
    while (pause := _met(pauses, span.release, span.end)) is not None:
        before = bisect_left(pauses, pause.start, key=lambda p: p.start) - 1
        free = max(free, pauses[before].end) if before >= 0 else free
        room = min(offset, pause.start - free)
        if pause.ends:
            return _fallen_by(span, pause.start, max(room, least * offset), free)
        if latest is not None and latest - pause.end >= least * offset:
            return replace(span, release=max(pause.end, latest - offset), end=latest)
        if latest is not None or room >= _MOST_OF * offset:
            return _fallen_by(span, pause.start, max(room, least * offset), free)
        free = pause.end
        span = replace(span, release=free, end=free + offset)
    return span


def _met(pauses: Sequence[StillTime], start: float, end: float) -> StillTime | None:
    """Return the first pause that lies at least in part within [start, end) seconds."""
    index = bisect_right(pauses, start + TICK, key=lambda p: p.end)
    return pauses[index] if index < len(pauses) and pauses[index].start < end - TICK else None


def _risen(span: MovementPhases, pauses: Sequence[StillTime], least: float) -> MovementPhases:
    """Return a span whose rise is over when a pause begins, or begins after it."""
    pause = _met(pauses, span.start, span.apex)
    if pause is None or pause.ends:
        return span
    if pause.start - span.start >= least * (span.apex - span.start):
        return replace(span, apex=pause.start, release=max(span.release, pause.start))
    return _later(span, pause.end - span.start)


def _later(span: MovementPhases, seconds: float) -> MovementPhases:
    return MovementPhases(*(t + seconds for t in (span.start, span.apex, span.release, span.end)))


def _fallen_by(span: MovementPhases, time: float, offset: float, free: float) -> MovementPhases:
    """Return a span that has fallen by a time, within `offset` seconds; it does not fall before `free`."""
    release = max(time - offset, free)
    return replace(span, release=release, end=release + offset)


def _ended(span: MovementPhases, time: float) -> MovementPhases:
    """Return a span that is shortened so that it has ended at a time, if that leaves it `least_time`."""
    share = max((time - span.start) / (span.end - span.start), synchrony().least_time)
    if share >= 1.0:
        return span
    apex, release, end = (span.start + share * (t - span.start) for t in (span.apex, span.release, span.end))
    return MovementPhases(span.start, apex, release, end)


def next_pause(time: float, pauses: Sequence[StillTime]) -> tuple[float, float, float]:
    """Return the seconds from a time to the next pause, those of the pause, and those to the one after it.

    The last are 0 if no other pause comes.
    """
    index = bisect_left(pauses, time, key=lambda p: p.start)
    if index == len(pauses):
        return math.inf, 0.0, 0.0
    pause, *later = pauses[index : index + 2]
    return pause.start - time, pause.end - pause.start, later[0].start - pause.end if later else 0.0


def after_pauses(time: float, seconds: float, pauses: Sequence[StillTime]) -> float:
    """Return a time from which on no short pause comes for some seconds, the given one if it is such."""
    while (pause := _met(pauses, time, time + seconds)) is not None and pause.end - pause.start <= _SHORT:
        time = pause.end
    return time
