"""Pitch that is kept: the same as measured; measured anew for other sound, another voice, another time."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.speech.audio import Audio, AudioWriter
from risorius.speech.prosody import pitch_cache
from risorius.speech.prosody.pitch import measure_pitch
from risorius.speech.prosody.pitch_cache import PitchCache
from risorius.speech.prosody.running import RunningRange, known_voice, unknown_speaker
from risorius.speech.resampled import Resampled

RATE = 16_000
T = np.arange(2 * RATE) / RATE
SOUND = sum(3_000 / k * np.cos(2 * np.pi * 150 * k * (T + 0.02 * np.sin(3 * T))) for k in range(1, 8))


def recorded(sound: np.ndarray) -> Audio:
    with AudioWriter(RATE) as writer:
        writer.append(np.round(sound).astype(np.int16))
        return writer.finish()


@pytest.fixture
def measured(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The ends of what was measured."""
    ends: list[float] = []

    def counted(resampled: Resampled, start: float, end: float, speaker: RunningRange | None = None):  # type: ignore[no-untyped-def]
        ends.append(end)
        return measure_pitch(resampled, start, end, speaker)

    monkeypatch.setattr(pitch_cache, "measure_pitch", counted)
    return ends


def test_sound_that_goes_on_is_measured_only_where_it_does(measured: list[float]) -> None:
    cache, speaker = PitchCache(), unknown_speaker().range
    short, long = (Resampled(recorded(SOUND[: round(seconds * RATE)])) for seconds in (1.2, 2.0))
    for resampled in (short, long):
        kept = cache.measure(resampled, 0.2, 1.0, speaker)
        np.testing.assert_array_equal(kept.hertz, measure_pitch(long, 0.2, 1.0, speaker).hertz)
    cache.measure(long, 1.0, 1.9, speaker)
    assert measured == [1.0, 1.9]


def test_all_that_a_measurement_depends_on_counts(measured: list[float]) -> None:
    cache, speaker = PitchCache(), unknown_speaker().range
    other = SOUND.copy()
    # Behind the run, but heard by its last frames.
    other[RATE + 100 : RATE + 200] = 0.0
    resampled = Resampled(recorded(SOUND))
    cases = [
        (resampled, 0.2, 1.0, speaker),
        (Resampled(recorded(other)), 0.2, 1.0, speaker),
        (resampled, 0.3, 1.0, speaker),
        (resampled, 0.2, 1.1, speaker),
        (resampled, 0.2, 1.0, known_voice(120.0).range),
    ]
    for case in cases * 2:
        np.testing.assert_array_equal(cache.measure(*case).hertz, measure_pitch(*case).hertz)
    assert len(measured) == len(cases)


def test_it_keeps_the_latest(measured: list[float]) -> None:
    cache, speaker, resampled = PitchCache(most=2), unknown_speaker().range, Resampled(recorded(SOUND))
    for end in (1.0, 1.1, 1.0, 1.2, 1.0, 1.1):
        cache.measure(resampled, 0.2, end, speaker)
    assert len(cache) == 2
    assert measured == [1.0, 1.1, 1.2, 1.1]
