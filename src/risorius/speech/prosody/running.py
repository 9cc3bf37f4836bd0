"""Statistics of the sound so far, which start from priors: later sound does not change them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array
from .priors import NormalPrior, priors

# Standard deviations that a single value may count for.
_MOST = 3.0
# Semitones above 1 Hz between which pitch is counted, and of a bin.
_LOWEST, _HIGHEST, _BIN = 70.0, 110.0, 0.05


@dataclass(slots=True)
class RunningNormal:
    """Mean and standard deviation of values that come bit by bit.

    The mean counts like `mean_count` values, the deviation like `count`; both like `most` at most, so that
    a speaker who changes is followed.
    """

    mean: float
    deviation: float
    mean_count: float
    count: float
    most: float

    def add(self, values: Array) -> None:
        """Count further values, shape (n,)."""
        number = len(values)
        if not number:
            return
        mean = float(values.mean())
        # How far the values lie from where they were thought to lie, as far as that was known.
        moved = self.mean_count * number / (self.mean_count + number) * (mean - self.mean) ** 2
        squares = self.count * self.deviation**2 + float(((values - mean) ** 2).sum()) + moved
        self.deviation = math.sqrt(squares / (self.count + number))
        self.mean += (mean - self.mean) * number / (self.mean_count + number)
        self.mean_count = min(self.mean_count + number, self.most)
        self.count = min(self.count + number, self.most)

    def standard(self, values: Array) -> Array:
        """Return values in standard deviations from the mean, at most 3, shape (n,)."""
        return np.asarray(np.clip((values - self.mean) / self.deviation, -_MOST, _MOST))


@dataclass(frozen=True, slots=True)
class PitchRange:
    """Quantiles 0.05, 0.25, 0.75 and 0.95 of a speaker's pitch, semitones above 1 Hz."""

    low: float
    lower: float
    upper: float
    high: float


class RunningRange:
    """The range of a speaker's pitch, from frames that come bit by bit.

    It starts around `median`, which counts like `median_count` frames, as wide as speakers' ranges are. What
    was before the latest frames counts like `most` frames.
    """

    def __init__(self, median: float, median_count: float, most: float) -> None:
        self._median, self._median_count = median, median_count
        self._prior = self._most = most
        self._counts = np.zeros(round((_HIGHEST - _LOWEST) / _BIN))

    def add(self, semitones: Array) -> None:
        """Count further voiced frames, semitones above 1 Hz, shape (n,)."""
        weight = self._most / (self._prior + float(self._counts.sum()))
        self._prior *= weight
        self._median_count *= weight
        self._counts = weight * self._counts + _counted(semitones)

    def with_frames(self, semitones: Array) -> PitchRange:
        """Return the range so far and of further frames, which are not counted."""
        return self._range(self._counts + _counted(semitones))

    @property
    def state(self) -> tuple[float, float, float, float, bytes]:
        """All that the range depends on."""
        return self._median, self._median_count, self._prior, self._most, self._counts.tobytes()

    @property
    def range(self) -> PitchRange:
        """The range so far."""
        return self._range(self._counts)

    def _range(self, counts: Array) -> PitchRange:
        usual = priors().range_
        frames = float(counts.sum())
        median = _quantile(counts, 0.5)
        middle = (self._median_count * self._median + frames * median) / (self._median_count + frames)

        def quantile(share: float, offset: float) -> float:
            measured = frames * _quantile(counts, share)
            return (self._prior * (middle + offset) + measured) / (self._prior + frames)

        return PitchRange(
            quantile(0.05, usual.low),
            quantile(0.25, usual.lower),
            quantile(0.75, usual.upper),
            quantile(0.95, usual.high),
        )


def _counted(semitones: Array) -> Array:
    """Return how many values lie in each bin."""
    last = round((_HIGHEST - _LOWEST) / _BIN) - 1
    bins = np.clip((semitones - _LOWEST) / _BIN, 0, last).astype(np.int64)
    return np.bincount(bins, minlength=last + 1).astype(np.float64)


def _quantile(counts: Array, share: float) -> float:
    """Return a quantile of counted values, evenly spread within a bin; the lowest value for none."""
    reached = np.cumsum(counts)
    count = share * float(reached[-1])
    index = int(np.searchsorted(reached, count))
    if not counts[index]:
        return _LOWEST + _BIN * index
    return _LOWEST + _BIN * (index + 1 - (float(reached[index]) - count) / float(counts[index]))


class SpeakerStatistics:
    """All that is known of a speaker so far."""

    def __init__(self, pitch: RunningNormal, range_: RunningRange) -> None:
        usual = priors()
        count = usual.seconds * usual.syllables
        self.pitch, self.range = pitch, range_

        def running(prior: NormalPrior) -> RunningNormal:
            return RunningNormal(prior.mean, prior.deviation, count, count, count)

        self.peak, self.loudness, self.stress = map(running, (usual.peak, usual.loudness, usual.stress))
        self.length, self.lengthening = running(usual.length), running(usual.lengthening)
        self.standing = running(usual.standing)
        # Sum and number of the log lengths of each vowel.
        self.vowels: dict[str, tuple[float, int]] = {}


def unknown_speaker() -> SpeakerStatistics:
    """Return the statistics of a speaker who has not been heard: those of people in general."""
    usual = priors()
    weight = (usual.pitch.deviation / usual.pitch.between) ** 2
    return _speaker(usual.pitch.mean, usual.pitch.deviation, weight, weight)


def known_voice(hertz: float) -> SpeakerStatistics:
    """Return the statistics of a synthesizer's voice: the mean of its pitch."""
    usual = priors()
    syllables = usual.seconds * usual.syllables
    return _speaker(12.0 * float(np.log2(hertz)), usual.voice.deviation, syllables, _frames())


def _speaker(mean: float, deviation: float, mean_syllables: float, mean_frames: float) -> SpeakerStatistics:
    usual = priors()
    syllables = usual.seconds * usual.syllables
    pitch = RunningNormal(mean, deviation, mean_syllables, syllables, syllables)
    return SpeakerStatistics(pitch, RunningRange(mean, mean_frames, _frames()))


def _frames() -> float:
    """Return the voiced frames, a hundred a second, of as much speech as priors count like."""
    return 100.0 * priors().seconds * priors().voiced
