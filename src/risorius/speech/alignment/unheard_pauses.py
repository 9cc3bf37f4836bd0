"""Put silence between two words where the decoder has none or too little, and nothing sounds.

Before a weak sound or a closure ("then. The", "Paul, come") the decoder often lets the second word begin with
the pause. A pause is a stretch between the two words in which no band rises above its floor, longer than the
closures of stops beside it are.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...core.arrays import Array, BoolArray
from ...core.speech.utterance import SILENCE
from ...languages import phonesets
from .decoder import AlignedPhone
from .spectra import STEP_SECONDS

# Seconds that a pause lasts at least, more for each stop beside it, and what the sounds beside it keep.
SHORTEST, PER_CLOSURE = 0.11, 0.06
_KEPT, _KEPT_STOP = 0.02, 0.05
# A sound after silence that is silent for so long begins later.
_LATE = 0.09
# The floor of a band, of its levels in a stretch, and how far above it is still nothing (ln of power: 10 dB).
_FLOOR_PERCENTILE, _ABOVE = 2.0, np.log(10.0)
# The lowest bands are quiet below this level as well: an echo, or breath, 25 dB below the voice.
_LOW_BANDS, _ECHO = 3, -5.0
# Steps that may sound within a pause: a click.
_CLICK = 4
NO_WORD = -1


def with_pauses(levels: Array, phones: Sequence[AlignedPhone], start: float) -> list[AlignedPhone]:
    """Return contiguous phones with silence put between words of which the second begins with a pause.

    `levels` (steps, bands) are those of the sound from `start` seconds on (`spectra.band_levels`).
    """
    least = np.percentile(levels, _FLOOR_PERCENTILE, axis=0) + _ABOVE
    least[:_LOW_BANDS] = np.maximum(least[:_LOW_BANDS], _ECHO)
    quiet = (levels < least).all(axis=1)
    found: list[AlignedPhone] = []
    for phone in phones:
        before = found[-1] if found else None
        if before is not None and 0 <= before.word < phone.word:
            pause = _pause(quiet, before, phone, start)
            if pause is not None:
                found[-1] = before._replace(end=pause[0])
                found.append(AlignedPhone(SILENCE, *pause, NO_WORD, 0.0))
                phone = phone._replace(start=pause[1])
        elif before is not None and before.word == NO_WORD and phone.word != NO_WORD:
            late = _sounds_from(quiet, phone, start)
            found[-1] = before._replace(end=late)
            phone = phone._replace(start=late)
        found.append(phone)
    return found


def _pause(
    quiet: BoolArray, before: AlignedPhone, after: AlignedPhone, start: float
) -> tuple[float, float] | None:
    """Return the longest pause between the beginning of one phone and the end of the next, if any."""
    stops = [phonesets.is_stop(phone.symbol) for phone in (before, after)]
    if after.end - before.start < SHORTEST:
        return None
    first = before.start + (_KEPT_STOP if stops[0] else _KEPT)
    last = after.end - _KEPT
    steps = [round((time - start) / STEP_SECONDS) for time in (first, last)]
    run = _longest(quiet[max(steps[0], 0) : max(steps[1], 0)])
    if (run[1] - run[0]) * STEP_SECONDS < SHORTEST + PER_CLOSURE * sum(stops):
        return None
    begin = start + (max(steps[0], 0) + run[0]) * STEP_SECONDS
    return begin, begin + (run[1] - run[0]) * STEP_SECONDS


def _sounds_from(quiet: BoolArray, phone: AlignedPhone, start: float) -> float:
    """Return when a phone after silence begins to sound; when it begins, if that is nearly at once."""
    first, last = (round((time - start) / STEP_SECONDS) for time in (phone.start, phone.end - _KEPT))
    inside = quiet[max(first, 0) : max(last, 0)]
    length = int(np.argmin(inside)) if len(inside) and not inside.all() else len(inside)
    return phone.start + length * STEP_SECONDS if length * STEP_SECONDS >= _LATE else phone.start


def _longest(quiet: BoolArray) -> tuple[int, int]:
    """Return first and last + 1 of the longest run of quiet steps, clicks included; (0, 0) for none."""
    bounds = np.flatnonzero(np.diff(np.concatenate(([False], quiet, [False])).astype(np.int8)))
    joined: list[tuple[int, int]] = []
    for first, last in bounds.reshape(-1, 2).tolist():
        if joined and first - joined[-1][1] <= _CLICK:
            first = joined.pop()[0]
        joined.append((first, last))
    return max(joined, key=lambda run: run[1] - run[0], default=(0, 0))
