"""Resampled recordings: any stretch at 16 kHz, as though the whole had been resampled, at one level."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.core.speech.audio import Audio, AudioWriter
from risorius.speech.resampled import LEVEL_STEP, RATE, SPEECH_LEVEL, Resampled


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


@pytest.mark.parametrize("seconds", [3.0, 130.0])
def test_the_loud_level_is_that_of_the_sound_so_far(seconds: float) -> None:
    loud = np.where(np.arange(round(seconds * 16_000)) < 0.5 * seconds * 16_000, 0.1, 1.0)
    resampled = Resampled(recorded(loud * wave(16_000, seconds), 16_000))
    for end in (0.2 * seconds, 0.49 * seconds, 0.8 * seconds, 2.0 * seconds):
        expected = np.percentile(resampled.levels[: round(end / LEVEL_STEP)], 95.0)
        assert resampled.loud_level(end) == pytest.approx(expected, abs=0.05)
    assert resampled.loud_level(0.8 * seconds) - resampled.loud_level(0.4 * seconds) == pytest.approx(
        20.0, abs=0.1
    )
