"""What makes a syllable stand out: how high, loud and long it is beside the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...core.arrays import Array
from ...core.utterance import Phone, Syllable, Utterance
from ...languages import phonesets
from ..recordings.resampled import LEVEL_STEP, Resampled
from .contour import Contour
from .rules import prosody_rules

# A phrase's pitch and loudness fall along it; cues are measured from a line through this many syllables at
# least.
_FEWEST_FOR_A_LINE = 4
# Standard deviations that a single cue may count for.
_MOST = 3.0


@dataclass(frozen=True, slots=True)
class Cues:
    """Per syllable, (n,) each.

    `pitch` in semitones above the phrase's line, `height` of the vowel's mean pitch in standard deviations,
    `loudness` in dB above the mean, `length` as the log of how much longer its vowel is than that vowel's
    mean, `prominence` in standard deviations.
    """

    pitch: Array
    height: Array
    loudness: Array
    length: Array
    prominence: Array


def cues_of(utterance: Utterance, resampled: Resampled, contour: Contour | None) -> Cues:
    """Return the cues of all syllables of an utterance."""
    vowels = [vowel_of(utterance.phones, syllable) for syllable in utterance.syllables]
    loudness = np.array([_level(resampled, vowel) for vowel in vowels])
    length = _relative_lengths(vowels)
    phrases = _phrases(utterance)
    peaks = np.array([contour.within(v.start, v.end).max() if contour else 0.0 for v in vowels])
    pitch = _above_line(peaks, phrases)
    share = prosody_rules().prominence
    standing = (
        share.pitch * _standard(pitch)
        + share.loudness * _standard(_above_line(loudness, phrases))
        + share.length * _standard(length)
    )
    louder = loudness - loudness.mean() if len(loudness) else loudness
    return Cues(pitch, heights_of(vowels, contour), louder, length, _standard(standing))


def heights_of(vowels: Sequence[Phone], contour: Contour | None) -> Array:
    """Return the mean pitch of each vowel in standard deviations of all, shape (n,)."""
    if contour is None:
        return np.zeros(len(vowels))
    return _standard(np.array([contour.within(v.start, v.end).mean() for v in vowels]))


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


def _relative_lengths(vowels: Sequence[Phone]) -> Array:
    """Return the log lengths of vowels above the mean of the same vowel, drawn to the mean of all."""
    logs = np.log(np.array([vowel.duration for vowel in vowels]))
    if not len(logs):
        return np.zeros(0)
    usual = {}
    for symbol in {vowel.symbol for vowel in vowels}:
        same = [x for x, vowel in zip(logs, vowels, strict=True) if vowel.symbol == symbol]
        # Two syllables' weight for the mean of all: a vowel that occurs once says little about its kind.
        usual[symbol] = (sum(same) + 2.0 * float(logs.mean())) / (len(same) + 2.0)
    return np.asarray(logs - np.array([usual[vowel.symbol] for vowel in vowels]))


def _phrases(utterance: Utterance) -> list[range]:
    """Return the runs of syllables between pauses."""
    ends = {pause.start for pause in utterance.pauses}
    runs: list[range] = []
    first = 0
    for index, syllable in enumerate(utterance.syllables):
        last = index + 1 == len(utterance.syllables)
        if last or (utterance.syllables[index + 1].word != syllable.word and syllable.end in ends):
            runs.append(range(first, index + 1))
            first = index + 1
    return runs


def _above_line(values: Array, phrases: Sequence[range]) -> Array:
    """Return the values less the line that falls or rises through each phrase."""
    found = values.copy()
    for phrase in phrases:
        inside = values[phrase.start : phrase.stop]
        if len(inside) >= _FEWEST_FOR_A_LINE:
            at = np.arange(len(inside))
            found[phrase.start : phrase.stop] -= np.polyval(np.polyfit(at, inside, 1), at)
        else:
            found[phrase.start : phrase.stop] -= inside.mean()
    return found


def _standard(values: Array) -> Array:
    spread = float(values.std()) if len(values) else 0.0
    if spread < 1e-9:
        return np.zeros_like(values)
    return np.asarray(np.clip((values - values.mean()) / spread, -_MOST, _MOST))
