"""Pitch: known contours are found within a tenth of a semitone, without octave errors."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.speech.audio import AudioWriter
from risorius.speech.prosody.contour import contour_of
from risorius.speech.prosody.pitch import Pitch, measure_pitch
from risorius.speech.prosody.running import unknown_speaker
from risorius.speech.resampled import Resampled

RATE = 16_000
T = np.arange(2 * RATE) / RATE
CONTOURS = {
    "level, low": 75.0 + 0.0 * T,
    "level, high": 420.0 + 0.0 * T,
    "an octave up": 110.0 * 2 ** (T / 2),
    "an octave down": 260.0 * 2 ** (-T / 2),
    "vibrato": 180.0 * 2 ** (np.sin(2 * np.pi * 3 * T) / 12),
}


def voice(hertz: np.ndarray, noise: float = 0.0, rate: int = RATE) -> np.ndarray:
    """Harmonics under two formants."""
    phase = 2 * np.pi * np.cumsum(hertz) / rate
    sound = np.zeros(len(hertz))
    for k in range(1, 30):
        f = k * hertz
        gain = 1 / k + 2 * np.exp(-(((f - 500) / 150) ** 2)) + np.exp(-(((f - 1500) / 200) ** 2))
        sound += np.where(f < 0.45 * rate, gain / k, 0.0) * np.cos(k * phase)
    sound *= 8_000 / np.abs(sound).max()
    return sound + np.random.default_rng(0).normal(0.0, 8_000 * noise, len(sound))


def measured(sound: np.ndarray, rate: int = RATE) -> Pitch:
    with AudioWriter(rate) as writer:
        writer.append(np.round(sound).astype(np.int16))
        audio = writer.finish()
    return measure_pitch(Resampled(audio), 0.0, audio.duration)


@pytest.mark.parametrize(
    "sound",
    [np.zeros(RATE), np.random.default_rng(1).normal(0.0, 3_000.0, RATE), np.zeros(1_000)],
    ids=["silence", "noise", "short"],
)
def test_what_has_no_voice_has_no_pitch(sound: np.ndarray) -> None:
    pitch = measured(sound)
    assert np.isfinite(pitch.hertz).mean() < 0.05
    assert contour_of(Pitch(np.full(10, np.nan)), unknown_speaker().range) is None


@pytest.mark.parametrize("noise", [0.0, 0.03])
@pytest.mark.parametrize("name", CONTOURS)
def test_contours_are_found(name: str, noise: float) -> None:
    pitch = measured(voice(CONTOURS[name], noise))
    inside = slice(5, -5)
    away = 12 * np.log2(pitch.hertz[inside] / np.interp(pitch.times[inside], T, CONTOURS[name]))
    assert np.isfinite(away).mean() > 0.97
    assert np.nanmedian(np.abs(away)) < 0.06
    assert np.nanmax(np.abs(away)) < 0.3


@pytest.mark.parametrize("rate", [8_000, 44_100])
def test_the_sample_rate_does_not_matter(rate: int) -> None:
    t = np.arange(rate) / rate
    pitch = measured(voice(150.0 + 0.0 * t, rate=rate), rate)
    assert pitch.hertz[5:-5] == pytest.approx(150.0, rel=0.003)


def test_voice_begins_and_ends_where_it_does() -> None:
    on = (T > 0.5) & (T < 1.5)
    pitch = measured(np.where(on, voice(150.0 + 0.0 * T), 0.0))
    voiced = pitch.times[np.isfinite(pitch.hertz)]
    assert voiced[0] == pytest.approx(0.5, abs=0.03)
    assert voiced[-1] == pytest.approx(1.5, abs=0.03)


def test_chunks_leave_no_seam() -> None:
    hertz = measured(voice(150.0 + 10.0 * np.sin(np.arange(11 * RATE) / RATE))).hertz
    assert np.abs(np.diff(hertz[5:-5])).max() < 0.5
