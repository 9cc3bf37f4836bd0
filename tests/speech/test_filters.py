"""Filters beside those of scipy, whose import takes longer than performing a line."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.ndimage import median_filter, uniform_filter1d

from risorius.speech.filters import low_pass, mean_of, median_of, with_rate

RATES = [(1, 3), (2, 1), (160, 441), (320, 441), (147, 160), (2, 3), (1, 1)]


def noise(count: int) -> np.ndarray:
    return np.random.default_rng(7).normal(size=count)


@pytest.mark.parametrize(("taps", "cutoff"), [(31, 0.2), (8, 0.9), (201, 0.01)])
def test_a_low_pass_is_that_of_scipy(taps: int, cutoff: float) -> None:
    from scipy.signal import firwin

    assert np.allclose(low_pass(np.hamming(taps), cutoff), firwin(taps, cutoff), rtol=0.0, atol=1e-15)
    kaiser = firwin(taps, cutoff, window=("kaiser", 5.0))
    assert np.allclose(low_pass(np.kaiser(taps, 5.0), cutoff), kaiser, rtol=0.0, atol=1e-15)


@pytest.mark.parametrize(("up", "down"), RATES)
@given(count=st.integers(0, 3000))
def test_sound_at_another_rate_is_that_of_scipy(up: int, down: int, count: int) -> None:
    from scipy.signal import resample_poly

    taps = low_pass(np.kaiser(20 * max(up, down) + 1, 5.0), 1.0 / max(up, down))
    samples = noise(count)
    found = with_rate(samples, up, down, taps)
    assert len(found) == -(-count * up // down)
    if count:
        assert np.allclose(found, resample_poly(samples, up, down, window=taps), rtol=0.0, atol=1e-12)


@given(count=st.integers(1, 60), width=st.sampled_from([1, 3, 5, 9]))
def test_smoothing_is_that_of_scipy(count: int, width: int) -> None:
    values = noise(count)
    assert np.array_equal(median_of(values, width), median_filter(values, width, mode="nearest"))
    assert np.allclose(mean_of(values, width), uniform_filter1d(values, width, mode="nearest"))
