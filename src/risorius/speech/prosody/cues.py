"""Cues that make a syllable stand out: its pitch, loudness and length beside the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array
from ...core.speech.utterance import Phone, Syllable, Utterance
from ...languages import phonesets
from ..resampled import LEVEL_STEP, Resampled
from .contour import Contour
from .rules import prosody_rules
from .running import RunningNormal, SpeakerStatistics
from .runs import Run

# Pitch and loudness fall along a run; cues are measured from a line through this many syllables at least.
_FEWEST_FOR_A_LINE = 4


@dataclass(frozen=True, slots=True)
class Cues:
    """Per syllable of a run, (n,) each, relative to the speaker's statistics up to the run's end.

    `height` of the vowel's mean pitch in standard deviations, `loudness` in dB above the mean, `length` as
    the log of how much longer its vowel is than that vowel's mean, `prominence` in standard deviations.
    """

    height: Array
    loudness: Array
    length: Array
    prominence: Array


def cues_of(
    utterance: Utterance,
    run: Run,
    resampled: Resampled,
    contour: Contour | None,
    speaker: SpeakerStatistics,
) -> Cues:
    """Return the cues of a run's syllables, of which there is at least one; adds them to the speaker's."""
    vowels = vowels_of(utterance, run)
    levels = np.array([_level(resampled, vowel) for vowel in vowels]) - resampled.loud_level(run.end)
    speaker.loudness.add(levels)
    peaks = np.array([contour.within(v.start, v.end).max() if contour else 0.0 for v in vowels])
    length = _relative_lengths(vowels, speaker)
    share = prosody_rules().prominence
    standing = (
        share.pitch * _standard(_above_line(peaks), speaker.peak)
        + share.loudness * _standard(_above_line(levels), speaker.stress)
        + share.length * _standard(length, speaker.lengthening)
    )
    return Cues(
        heights_of(vowels, contour, speaker),
        levels - speaker.loudness.mean,
        length,
        _standard(standing, speaker.standing),
    )


def heights_of(vowels: Sequence[Phone], contour: Contour | None, speaker: SpeakerStatistics) -> Array:
    """Return the mean pitch of each vowel in standard deviations of the speaker's, shape (n,)."""
    if contour is None:
        return np.zeros(len(vowels))
    means = np.array([contour.floor + contour.within(v.start, v.end).mean() for v in vowels])
    return _standard(means, speaker.pitch)


def vowels_of(utterance: Utterance, run: Run) -> list[Phone]:
    """Return the vowels of a run's syllables."""
    return [vowel_of(utterance.phones, utterance.syllables[index]) for index in run.syllables]


def vowel_of(phones: Sequence[Phone], syllable: Syllable) -> Phone:
    """Return the vowel of a syllable."""
    inside = phones[syllable.first_phone : syllable.last_phone]
    return next(phone for phone in inside if phonesets.is_vowel(phone.symbol))


def _level(resampled: Resampled, vowel: Phone) -> float:
    """Return the level of a vowel in dB: the mean power of its frames."""
    first = int(vowel.start / LEVEL_STEP)
    inside = resampled.levels[first : max(int(vowel.end / LEVEL_STEP), first + 1)]
    return (
        float(10.0 * np.log10(np.mean(10.0 ** (np.asarray(inside, np.float64) / 10.0))))
        if len(inside)
        else 0.0
    )


def _relative_lengths(vowels: Sequence[Phone], speaker: SpeakerStatistics) -> Array:
    """Return the log lengths of vowels above the mean of the same vowel, drawn to the mean of all."""
    logs = np.log(np.array([vowel.duration for vowel in vowels]))
    speaker.length.add(logs)
    for log, vowel in zip(logs.tolist(), vowels, strict=True):
        total, count = speaker.vowels.get(vowel.symbol, (0.0, 0))
        speaker.vowels[vowel.symbol] = total + log, count + 1
    return np.asarray(logs - np.array([_usual_length(vowel.symbol, speaker) for vowel in vowels]))


def _usual_length(symbol: str, speaker: SpeakerStatistics) -> float:
    total, count = speaker.vowels[symbol]
    # Two syllables' weight for the mean of all: a vowel that occurs once says little about its kind.
    return (total + 2.0 * speaker.length.mean) / (count + 2.0)


def _above_line(values: Array) -> Array:
    """Return the values of a run less the line that falls or rises through it."""
    if len(values) < _FEWEST_FOR_A_LINE:
        return np.asarray(values - values.mean())
    at = np.arange(len(values))
    return np.asarray(values - np.polyval(np.polyfit(at, values, 1), at))


def _standard(values: Array, speaker: RunningNormal) -> Array:
    """Return values in standard deviations of the speaker's, to which they are added first."""
    speaker.add(values)
    return speaker.standard(values)
