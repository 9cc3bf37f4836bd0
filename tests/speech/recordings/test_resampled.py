"""Resampled recordings: any stretch at 16 kHz, as though the whole had been resampled, at one level."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.audio import Audio, AudioWriter
from risorius.speech.recordings.resampled import RATE, SPEECH_LEVEL, Resampled


def recorded(samples: np.ndarray, rate: int) -> Audio:
    with AudioWriter(rate) as writer:
        writer.append(np.round(samples).astype(np.int16))
        return writer.finish()


def wave(rate: int, seconds: float = 2.0, hertz: float = 440.0) -> np.ndarray:
    return 8_000 * np.sin(2 * np.pi * hertz * np.arange(round(seconds * rate)) / rate)


@pytest.mark.parametrize("rate", [8_000, 11_025, 16_000, 22_050, 44_100, 48_000, 96_000])
def test_any_stretch_is_in_phase_with_the_whole(rate: int) -> None:
    resampled = Resampled(recorded(wave(rate), rate))
    got = resampled.read(0.61803, 1.3)
    first = round(0.61803 * RATE)
    expected = np.sin(2 * np.pi * 440 * (first + np.arange(len(got))) / RATE) * SPEECH_LEVEL * np.sqrt(2)
    assert len(got) == round((1.3 - 0.61803) * RATE)
    assert np.abs(got - expected).max() < 0.02 * SPEECH_LEVEL


@pytest.mark.parametrize("rate", [16_000, 44_100])
def test_beyond_its_ends_it_is_silent(rate: int) -> None:
    resampled = Resampled(recorded(wave(rate, 0.5), rate))
    assert not resampled.read(-1.0, -0.01).any()
    assert not resampled.read(0.51, 1.5).any()
    assert len(resampled.read(-0.5, 1.0)) == 1.5 * RATE
    assert len(resampled.read(1.0, 1.0)) == 0


def test_soft_and_loud_recordings_sound_alike() -> None:
    soft, loud = (Resampled(recorded(gain * wave(16_000), 16_000)).read(0.5, 1.0) for gain in (0.01, 3.0))
    assert np.abs(soft - loud).max() < 0.05 * SPEECH_LEVEL


def test_levels_are_measured_block_by_block() -> None:
    samples = np.concatenate([wave(16_000, 12.0), np.zeros(16_000)])
    levels = Resampled(recorded(samples, 16_000)).levels
    assert len(levels) == 1_300
    assert levels[:1_200] == pytest.approx(20 * np.log10(8_000 / np.sqrt(2)), abs=0.5)
    assert (levels[1_200:] == -20.0).all()
