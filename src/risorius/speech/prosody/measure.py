"""An utterance with the prosody measured in its sound."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from ...core.speech.utterance import Accent, Boundary, Syllable, Utterance
from ..resampled import Resampled
from ..structure.nuclei import with_nuclei
from ..structure.phrases import with_phrases
from .accents import find_accents
from .boundaries import find_boundaries
from .contour import Contour, contour_of
from .cues import Cues, cues_of, heights_of, vowels_of
from .pitch import Pitch, measure_pitch
from .running import RunningRange, SpeakerStatistics, known_voice, unknown_speaker
from .runs import Run, runs_of

MeasurePitch = Callable[[Resampled, float, float, RunningRange], Pitch]
"""Measures the pitch between two times, in seconds, of a voice with this range so far."""


def measured(
    utterance: Utterance,
    *,
    accents: bool = True,
    boundaries: bool = True,
    measure: MeasurePitch = measure_pitch,
) -> Utterance:
    """Return the utterance with its accents and boundaries measured, and how its syllables sound.

    Accents and boundaries that are not asked for stay as they are. Speech between two pauses is measured
    from the sound up to its end: later sound does not change it. `measure` measures its pitch.
    """
    resampled = Resampled(utterance.audio)
    speaker = unknown_speaker()
    syllables: list[Syllable] = []
    tones: list[Accent] = []
    ends: list[Boundary] = []
    written = {boundary.word for boundary in utterance.boundaries}
    for run in runs_of(utterance):
        if not run.syllables:
            continue  # a hum, or "sh": it has no accent, and no tone at its end
        contour = _contour(resampled, run, speaker, measure)
        cues = cues_of(utterance, run, resampled, contour, speaker)
        syllables += _sounding(utterance, run, cues)
        run_boundaries = find_boundaries(utterance, run, cues, contour, speaker) if boundaries else ()
        last_words = {boundary.word for boundary in run_boundaries} if boundaries else written
        ends += run_boundaries
        if accents:
            tones += find_accents(utterance, run, cues, contour, last_words)
    last_words = {boundary.word for boundary in ends} if boundaries else written
    heard = replace(
        utterance,
        syllables=tuple(syllables),
        accents=with_nuclei(tones, last_words) if accents else utterance.accents,
        boundaries=tuple(ends) if boundaries else utterance.boundaries,
    )
    return with_phrases(heard)


def pitched(
    utterance: Utterance, voice_hertz: float | None = None, measure: MeasurePitch = measure_pitch
) -> Utterance:
    """Return an utterance whose accents are known with the pitch of its syllables measured, by `measure`.

    `voice_hertz`: the mean pitch of the voice, if known.
    """
    resampled = Resampled(utterance.audio)
    speaker = unknown_speaker() if voice_hertz is None else known_voice(voice_hertz)
    heights: list[float] = []
    for run in runs_of(utterance):
        vowels = vowels_of(utterance, run)
        contour = _contour(resampled, run, speaker, measure) if vowels else None
        heights += heights_of(vowels, contour, speaker).tolist()
    syllables = zip(utterance.syllables, heights, strict=True)
    return replace(utterance, syllables=tuple(replace(s, pitch=round(h, 3)) for s, h in syllables))


def _contour(
    resampled: Resampled, run: Run, speaker: SpeakerStatistics, measure: MeasurePitch
) -> Contour | None:
    return contour_of(measure(resampled, run.start, run.end, speaker.range), speaker.range)


def _sounding(utterance: Utterance, run: Run, cues: Cues) -> Iterator[Syllable]:
    """Yield the syllables of a run with how they sound."""
    values = zip(run.syllables, cues.loudness, cues.prominence, cues.height, strict=True)
    for index, loudness, prominence, height in values:
        yield replace(
            utterance.syllables[index],
            loudness=round(float(loudness), 3),
            prominence=round(float(prominence), 3),
            pitch=round(float(height), 3),
        )


def speech_rate(utterance: Utterance) -> float:
    """Return syllables per second of speech, pauses left out; 0 if nothing is said."""
    spoken = sum(word.end - word.start for word in utterance.words)
    return len(utterance.syllables) / spoken if spoken > 0.0 else 0.0
