"""What the sound tells about closures and openings."""

from __future__ import annotations

import numpy as np
import pytest

from risorius.speech.engines import acoustics

RATE = 22_050


@pytest.mark.parametrize(("rate", "factor"), [(None, 1.0), (80, 1.0), (175, 1.0), (350, 0.5)])
def test_transitions_are_shorter_at_higher_rates_only(rate, factor) -> None:
    assert acoustics.tempo(rate) == factor


@pytest.mark.parametrize("silent", [0, 1, 400, 1000])
def test_silence_is_counted_back_from_the_burst(silent) -> None:
    samples = np.full(3000, 7, np.int16)
    samples[2000 - silent : 2000] = 0
    assert acoustics.silence_before(samples, 2000, 900) == min(silent, 900)


def test_silence_at_the_very_beginning() -> None:
    assert acoustics.silence_before(np.zeros(100, np.int16), 60, 900) == 60
    assert acoustics.silence_before(np.zeros(100, np.int16), 0, 900) == 0


def nasal_then_vowel(opening: int, growth: float) -> np.ndarray:
    time = np.arange(4000) / RATE
    wave = np.sin(2 * np.pi * 120 * time) + 0.5 * np.sin(2 * np.pi * 1100 * time)
    return (wave * np.where(np.arange(4000) < opening, 1000, 1000 * growth)).astype(np.int16)


@pytest.mark.parametrize("opening", [1700, 1900, 2100])
def test_the_opening_is_found_to_a_few_milliseconds(opening) -> None:
    found = acoustics.opening_before(nasal_then_vowel(opening, 8.0), 2200, 1500, RATE)
    assert abs(found - opening) < 0.003 * RATE


def test_without_a_sudden_growth_the_stamp_stays() -> None:
    assert acoustics.opening_before(nasal_then_vowel(1900, 1.3), 2200, 1500, RATE) == 2200
    assert acoustics.opening_before(np.zeros(3000, np.int16), 2200, 1500, RATE) == 2200
    assert acoustics.opening_before(np.zeros(30, np.int16), 20, 0, RATE) == 20
