"""An utterance with what its sound tells of how it is said."""

from __future__ import annotations

from dataclasses import replace

from ...core.utterance import Utterance
from ..recordings.resampled import Resampled
from ..structure.phrases import with_phrases
from .accents import find_accents
from .boundaries import find_boundaries
from .contour import contour_of
from .cues import cues_of, heights_of, vowel_of
from .pitch import measure_pitch


def measured(utterance: Utterance, *, accents: bool = True, boundaries: bool = True) -> Utterance:
    """Return the utterance with its accents and boundaries measured, and how its syllables sound.

    Accents and boundaries that are not asked for stay as they are.
    """
    resampled = Resampled(utterance.audio)
    contour = contour_of(measure_pitch(resampled))
    cues = cues_of(utterance, resampled, contour)
    syllables = tuple(
        replace(
            syllable,
            loudness=round(float(loudness), 3),
            prominence=round(float(prominence), 3),
            pitch=round(float(height), 3),
        )
        for syllable, loudness, prominence, height in zip(
            utterance.syllables, cues.loudness, cues.prominence, cues.height, strict=True
        )
    )
    ends = find_boundaries(utterance, cues, contour) if boundaries else utterance.boundaries
    last_words = {boundary.word for boundary in ends}
    tones = find_accents(utterance, cues, contour, last_words) if accents else utterance.accents
    return with_phrases(replace(utterance, syllables=syllables, accents=tones, boundaries=ends))


def pitched(utterance: Utterance) -> Utterance:
    """Return an utterance whose accents are known with the pitch of its syllables measured."""
    contour = contour_of(measure_pitch(Resampled(utterance.audio))) if utterance.syllables else None
    if contour is None:
        return utterance
    vowels = [vowel_of(utterance.phones, syllable) for syllable in utterance.syllables]
    heights = zip(utterance.syllables, heights_of(vowels, contour).tolist(), strict=True)
    return replace(utterance, syllables=tuple(replace(s, pitch=round(h, 3)) for s, h in heights))


def speech_rate(utterance: Utterance) -> float:
    """Return syllables per second of speech, pauses left out; 0 where nothing is said."""
    spoken = sum(word.end - word.start for word in utterance.words)
    return len(utterance.syllables) / spoken if spoken > 0.0 else 0.0
