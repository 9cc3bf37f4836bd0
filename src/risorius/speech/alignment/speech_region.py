"""Find where the words of a transcript are in a recording that holds much more: music, noise, other speech.

The decoder takes what is not speech for silence, or puts words into it. So the first words, and the last, are
sought window by window; the window in which they fit best is that in which they are said.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from ..resampled import Resampled
from .confidence import DOUBTFUL_SILENCE, OWN, mean_score
from .decoder import AlignedPhone, AlignmentError, Decoders, Readings

# At each end, this number of words is sought within this number of seconds.
SOUGHT_WORDS, SOUGHT_SECONDS = 14, 60.0
# A window is longer than its words are usually spoken: by this factor, and by these seconds; and it begins
# this share of their length after the one before.
_ROOM, _ROOM_SECONDS, _STEP = 1.6, 1.5, 0.5
_SHORTEST_STEP, _FINE = 0.5, 3
# Words that last much longer or shorter than usual (natural logarithm of the ratio) fit worse.
_USUAL_RATE, _PER_RATE, _LEAST = 0.35, 25.0, 0.01
# Windows that fit so little worse than the best are as good.
_NEARLY = 2.0
# Seconds that are kept beside the words.
_MARGIN = 0.3
# A phone, or silence where something sounds, that lasts so long is no phone; so much missing speech is much.
_ENDLESS, _MUCH = 1.2, 1.0


class _Fit(NamedTuple):
    """How well words fit into a window, and when the first begins and the last ends there."""

    score: float
    start: float
    end: float


def is_lost(phones: Sequence[AlignedPhone], usual: float) -> bool:
    """Tell whether an alignment looks as if the recording held much more than the words.

    `phones` fill a recording without long silences; `usual`: how many seconds the words usually last.
    """
    missing = sum(f.end - f.start for f in phones if f.word < 0 and f.score < DOUBTFUL_SILENCE)
    longest = max((f.end - f.start for f in phones), default=0.0)
    if longest >= _ENDLESS or missing >= _MUCH:
        return True
    whole = phones[-1].end - phones[0].start if phones else 0.0
    poor = mean_score([f for f in phones if f.word >= 0]) < OWN.wrong
    return poor and whole > _ROOM * usual + _ROOM_SECONDS


def speech_region(
    resampled: Resampled, words: Sequence[Readings], usual: float, decoders: Decoders
) -> tuple[float, float] | None:
    """Return when the words begin and end in a recording, with some room; None if they fit nowhere.

    `usual`: how many seconds the words usually last.
    """
    duration = resampled.audio.duration
    count = min(len(words), SOUGHT_WORDS)
    length = max(usual, _SHORTEST_STEP) * count / len(words)
    head = _best(resampled, words[:count], length, (0.0, min(duration, SOUGHT_SECONDS + length)), decoders)
    if head is None:
        return None
    tail = head
    if count < len(words):
        last = (max(0.0, duration - SOUGHT_SECONDS - length), duration)
        found = _best(resampled, words[-count:], length, last, decoders)
        if found is None or found.end <= head.start:
            return None
        tail = found
    return max(0.0, head.start - _MARGIN), min(duration, tail.end + _MARGIN)


def _best(
    resampled: Resampled,
    words: Sequence[Readings],
    length: float,
    within: tuple[float, float],
    decoders: Decoders,
) -> _Fit | None:
    """Return the best fit of words that usually last `length` seconds; None for none that is good."""
    room = _ROOM * length + _ROOM_SECONDS
    step = max(_STEP * length, _SHORTEST_STEP)

    def fits(starts: Sequence[float]) -> Iterator[tuple[_Fit, float]]:
        for start in starts:
            end = min(start + room, within[1])
            try:
                phones = decoders.fit_words(resampled.read(start, end), words)
            except AlignmentError:
                continue
            said = [phone for phone in phones if phone.word >= 0]
            first, last = said[0].start, said[-1].end
            strange = max(0.0, abs(np.log(max(last - first, _LEAST) / length)) - _USUAL_RATE)
            yield _Fit(mean_score(said) - _PER_RATE * strange, start + first, start + last), start

    last = max(within[1] - 0.5 * length, within[0] + step)
    coarse_fits = list(fits(np.arange(within[0], last, step).tolist()))
    if not coarse_fits:
        return None
    coarse = max(coarse_fits)
    near = coarse[1] + step / _FINE * np.arange(1 - _FINE, 2 * _FINE)
    fine = fits([start for start in near.tolist() if start >= within[0] and start != coarse[1]])
    found = [coarse, *fine]
    least = max(fit.score for fit, _ in found) - _NEARLY
    # The less of what is not speech is heard, the less of it is taken for a word.
    return max((start, fit) for fit, start in found if fit.score >= least)[1]
