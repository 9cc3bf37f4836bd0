"""Find the stretches of a recording in which anything sounds, and leave long silences out of it.

The decoder takes the mean of what it hears away, so long silence, of any loudness, changes how well speech
fits. What it hears has no silence longer than twice `PAD`; times are put back afterwards.

A frame sounds if it is louder than the noise around it, the floor: the level that a tenth of the frames
within a few seconds stay below. So noise of any level is silence, as long as it is steady.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array, BoolArray
from ...core.speech.audio import Audio, AudioWriter
from ...core.speech.utterance import SILENCE
from ..resampled import LEVEL_STEP, Resampled
from .decoder import AlignedPhone

# Seconds of silence that are kept beside a sound, and the least that is worth leaving out.
PAD, LEAST_LEFT_OUT = 0.25, 0.3
# dB above the floor from which a frame sounds, and below the loudest half second down to which. What is
# louder than the third, below that half second, sounds however steady it is: a long vowel is not noise.
ABOVE_FLOOR, BELOW_LOUD, STEADY = 8.0, 45.0, 12.0
# Frames: the mean of levels, half of the span of the floor, in blocks, and the shortest sound.
_SMOOTH, _BLOCK, _REACH, _SHORTEST = 5, 10, 15, 4
_LOUD_FRAMES = 50
_FLOOR_SHARE = 10.0
NO_WORD = -1


@dataclass(frozen=True, slots=True)
class Condensed:
    """A recording without its long silences: `audio`, and the `pieces` of the recording that it holds.

    Pieces are (start, end) in seconds of the recording, in order; it lasts `duration`.
    """

    audio: Audio
    pieces: tuple[tuple[float, float], ...]
    duration: float

    def time(self, seconds: float) -> float:
        """Return the time in the recording of a time in `audio`."""
        for start, end in self.pieces:
            if seconds <= end - start:
                return start + seconds
            seconds -= end - start
        return self.pieces[-1][1]

    def placed(self, phones: Sequence[AlignedPhone]) -> list[AlignedPhone]:
        """Return phones that fill `audio` at their times in the recording, which they fill as well.

        A phone of a word that is found across silence that was left out stays on the side of its longer part.
        """
        starts = np.cumsum([0.0, *(end - start for start, end in self.pieces)]).tolist()
        placed: list[AlignedPhone] = []
        for phone in phones:
            first = min(max(bisect_right(starts, phone.start + _ROUNDING) - 1, 0), len(self.pieces) - 1)
            last = min(max(bisect_right(starts, phone.end - _ROUNDING) - 1, first), len(self.pieces) - 1)
            start = self.pieces[first][0] + phone.start - starts[first]
            end = self.pieces[last][0] + phone.end - starts[last]
            if phone.word == NO_WORD or first == last:
                placed.append(phone._replace(start=start, end=end))
                continue
            side = max(range(first, last + 1), key=lambda k: _common(phone, starts[k], starts[k + 1]))
            start, end = max(start, self.pieces[side][0]), min(end, self.pieces[side][1])
            placed.append(phone._replace(start=start, end=end))
        return _with_silences(placed, self.duration)


_ROUNDING = 1e-6


def _common(phone: AlignedPhone, start: float, end: float) -> float:
    return min(phone.end, end) - max(phone.start, start)


def _with_silences(phones: Sequence[AlignedPhone], duration: float) -> list[AlignedPhone]:
    """Return phones with silence wherever one begins later than the one before ends, over [0, duration]."""
    filled: list[AlignedPhone] = []
    for phone in (*phones, AlignedPhone(SILENCE, duration, duration, NO_WORD, 0.0)):
        reached = filled[-1].end if filled else 0.0
        if phone.start > reached + _ROUNDING:
            if filled and filled[-1].word == NO_WORD:
                filled[-1] = filled[-1]._replace(end=phone.start)
            elif phone.word == NO_WORD:
                phone = phone._replace(start=reached)
            else:
                filled.append(AlignedPhone(SILENCE, reached, phone.start, NO_WORD, 0.0))
        filled.append(phone)
    return filled if filled[-1].end - filled[-1].start > _ROUNDING else filled[:-1]


def condensed(resampled: Resampled) -> Condensed:
    """Return a recording without its long silences; itself if it has none."""
    audio = resampled.audio
    spans = _kept(sounding(np.asarray(resampled.levels, np.float64)), audio.duration)
    if spans == [(0.0, audio.duration)]:
        return Condensed(audio, ((0.0, audio.duration),), audio.duration)
    rate = audio.sample_rate
    pieces = []
    with AudioWriter(rate) as writer:
        for start, end in spans:
            first, last = round(start * rate), min(round(end * rate), audio.frames)
            for at in range(first, last, _COPIED):
                writer.append(audio.read(at, min(_COPIED, last - at)))
            pieces.append((first / rate, last / rate))
        return Condensed(writer.finish(), tuple(pieces), audio.duration)


_COPIED = 1 << 20  # samples at a time


def _kept(sounds: BoolArray, duration: float) -> list[tuple[float, float]]:
    """Return the spans in seconds that are kept: sounds with silence of at most PAD to both sides."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], sounds, [False]))))
    runs = [
        (max(first * LEVEL_STEP - PAD, 0.0), min(last * LEVEL_STEP + PAD, duration))
        for first, last in edges.reshape(-1, 2).tolist()
        if last - first >= _SHORTEST
    ]
    if not runs:
        return [(0.0, duration)]
    if runs[0][0] < LEAST_LEFT_OUT:
        runs[0] = 0.0, runs[0][1]
    if duration - runs[-1][1] < LEAST_LEFT_OUT:
        runs[-1] = runs[-1][0], duration
    joined = [runs[0]]
    for start, end in runs[1:]:
        if start - joined[-1][1] < LEAST_LEFT_OUT:
            joined[-1] = joined[-1][0], end
        else:
            joined.append((start, end))
    return joined


def sounding(levels: Array) -> BoolArray:
    """Tell for each frame whether it is louder than the noise around it; `levels` (frames,) in dB."""
    power = np.convolve(10.0 ** (levels / 10.0), np.full(_SMOOTH, 1.0 / _SMOOTH), "same")
    smooth = 10.0 * np.log10(power + 1e-9)
    half_seconds = np.convolve(power, np.full(_LOUD_FRAMES, 1.0 / _LOUD_FRAMES), "same")
    loud = 10.0 * np.log10(half_seconds.max() + 1e-9)
    least = np.minimum(floor(smooth) + ABOVE_FLOOR, loud - STEADY)
    return np.asarray(smooth > np.maximum(least, loud - BELOW_LOUD))


def floor(levels: Array) -> Array:
    """Return the level of the noise around each frame, in dB, shape (frames,)."""
    count = len(levels)
    blocks = -(-count // _BLOCK)
    padded = np.pad(levels, (0, blocks * _BLOCK - count), mode="edge").reshape(blocks, _BLOCK)
    lowest = np.percentile(padded, _FLOOR_SHARE, axis=1)
    around = np.pad(lowest, _REACH, mode="reflect" if blocks > _REACH else "edge")
    windows = np.lib.stride_tricks.sliding_window_view(around, 2 * _REACH + 1)
    return np.repeat(np.percentile(windows, _FLOOR_SHARE, axis=1), _BLOCK)[:count]
