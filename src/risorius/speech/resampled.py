"""Recordings as the measuring stages hear them: at 16 kHz, speech at one level, any stretch at a time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from ..core.arrays import Array, Float32Array, Int32Array
from ..core.speech.audio import Audio
from .filters import low_pass, with_rate

RATE = 16_000
# The level to which the loud frames of speech are brought, in units of 16-bit samples (root mean square).
SPEECH_LEVEL = 2_500.0
# Seconds per frame of `levels`.
LEVEL_STEP = 0.01
_LOUD_SHARE = 0.95
# Levels are counted in bins (dB), in blocks of frames.
_LOWEST_LEVEL, _LEVEL_BIN, _LEVELS = -20.0, 0.02, 6000
_FRAMES_PER_BLOCK = 6_000
_CHUNK_SECONDS = 10.0
# The resampling filter reaches ten samples of the slower rate to both sides; taken twice to be safe.
_MARGIN = 20


@dataclass(frozen=True)
class Resampled:
    """Access to a recording at 16 kHz; nothing but frame levels stays in memory."""

    audio: Audio

    def read(self, start: float, end: float) -> Array:
        """Return the sound of [start, end) in seconds at 16 kHz, shape (n,), in units of 16-bit samples.

        The first sample is the one nearest to `start`. Samples outside the recording are silent. The level
        is that at which loud speech up to `end` has a root mean square of 2,500.
        """
        first, count = round(start * RATE), round((end - start) * RATE)
        gain = SPEECH_LEVEL / math.exp(math.log(10.0) * self.loud_level(end) / 20.0)
        return gain * _resampled(self.audio, first, max(count, 0))

    def loud_level(self, end: float) -> float:
        """Return the level of loud speech up to `end` seconds, in dB, which one frame in twenty exceeds."""
        count = min(max(round(end / LEVEL_STEP), 1), len(self.levels))
        blocks = count // _FRAMES_PER_BLOCK
        counts = self._level_counts[blocks] + _counted(self.levels[blocks * _FRAMES_PER_BLOCK : count])
        reached = np.cumsum(counts)
        loud_count = _LOUD_SHARE * count
        index = int(np.searchsorted(reached, loud_count))
        within = (loud_count - (reached[index - 1] if index else 0)) / max(int(counts[index]), 1)
        return _LOWEST_LEVEL + _LEVEL_BIN * float(index + within)

    @cached_property
    def _level_counts(self) -> Int32Array:
        """The number of frames before each block that have each level, shape (blocks + 1, levels)."""
        blocks = len(self.levels) // _FRAMES_PER_BLOCK
        counts = np.zeros((blocks + 1, _LEVELS), np.int32)
        for block in range(blocks):
            first = block * _FRAMES_PER_BLOCK
            counts[block + 1] = counts[block] + _counted(self.levels[first : first + _FRAMES_PER_BLOCK])
        return counts

    @cached_property
    def levels(self) -> Float32Array:
        """Root mean square per 10 ms as dB of one 16-bit step, at least -20, shape (frames,)."""
        step = LEVEL_STEP * self.audio.sample_rate
        frames_per_chunk = round(_CHUNK_SECONDS / LEVEL_STEP)
        total = max(math.ceil(self.audio.frames / step), 1)
        blocks = [
            _frame_levels(self.audio, range(first, min(first + frames_per_chunk, total)), step)
            for first in range(0, total, frames_per_chunk)
        ]
        return np.concatenate(blocks)


def _counted(levels: Float32Array) -> Int32Array:
    """Return how many levels lie in each bin."""
    bins = np.clip((levels - _LOWEST_LEVEL) / _LEVEL_BIN, 0, _LEVELS - 1).astype(np.int32)
    return np.bincount(bins, minlength=_LEVELS).astype(np.int32)


def _frame_levels(audio: Audio, frames: range, step: float) -> Float32Array:
    edges = np.round(np.arange(frames.start, frames.stop + 1) * step).astype(int)
    samples = audio.read(int(edges[0]), int(edges[-1] - edges[0])).astype(np.float64)
    power = np.concatenate(([0.0], np.cumsum(samples**2)))
    inside = np.minimum(edges - edges[0], len(samples))
    mean = np.diff(power[inside]) / np.maximum(np.diff(edges), 1)
    return np.asarray(10.0 * np.log10(mean + 0.01), dtype=np.float32)


def _resampled(audio: Audio, first: int, count: int) -> Array:
    """Return `count` samples at 16 kHz from sample `first` (at 16 kHz) on, zeros outside the sound."""
    divisor = math.gcd(RATE, audio.sample_rate)
    up, down = RATE // divisor, audio.sample_rate // divisor
    # The filter's phase repeats every `down` samples: begin at such a sample, with room for the filter.
    margin = _MARGIN * max(1, down // up)
    begin = (first * down // up - margin) // down * down
    end = -(-(first + count) * down // up) + margin
    source = _padded(audio, begin, end)
    factor = max(up, down)
    at_rate = source if factor == 1 else with_rate(source, up, down, _low_pass(factor))
    skipped = first - begin // down * up
    return np.ascontiguousarray(at_rate[skipped : skipped + count])


@cache
def _low_pass(rate: int) -> Array:
    """Return the filter for a change of rate; `rate`: the greater of the two factors."""
    return low_pass(np.kaiser(20 * rate + 1, 5.0), 1.0 / rate)


def _padded(audio: Audio, begin: int, end: int) -> Array:
    samples = audio.read(max(begin, 0), max(end - max(begin, 0), 0)).astype(np.float64)
    before = min(max(-begin, 0), end - begin)
    return np.pad(samples, (before, max(end - begin - before - len(samples), 0)))
