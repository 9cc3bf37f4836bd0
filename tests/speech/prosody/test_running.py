"""Running statistics: they start from priors, follow what is heard, and never look ahead."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.errors import InputError
from risorius.reading.toml import parse
from risorius.speech.prosody.priors import NormalPrior, priors
from risorius.speech.prosody.running import RunningNormal, RunningRange, known_voice, unknown_speaker

VALUES = st.lists(st.floats(-50.0, 50.0), max_size=30).map(np.array)


def normal(count: float = 25.0, most: float = 25.0) -> RunningNormal:
    return RunningNormal(2.0, 3.0, count, count, most)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mean = 1.0", "key 'deviation' is missing"),
        ("mean = 1.0\ndeviation = 0.0", "deviation = 0.0 is out of range"),
        ("mean = 1.0\ndeviation = 1.0\nmedian = 1.0", "unknown key 'median'"),
    ],
)
def test_priors_that_do_not_fit_are_refused(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse(NormalPrior, text, "priors.toml")


def test_without_values_the_prior_holds() -> None:
    running = normal()
    running.add(np.zeros(0))
    assert (running.mean, running.deviation) == (2.0, 3.0)
    assert running.standard(np.array([2.0, 5.0, -1.0, 99.0])).tolist() == [0.0, 1.0, -1.0, 3.0]


@given(st.lists(st.floats(-50.0, 50.0), min_size=1, max_size=30).map(np.array))
def test_a_prior_counts_like_so_many_values(values: np.ndarray) -> None:
    # Four values with a mean of 2 and a deviation of 3.
    before = np.array([-1.0, -1.0, 5.0, 5.0])
    running = RunningNormal(2.0, 3.0, 4.0, 4.0, 1e6)
    running.add(values)
    together = np.concatenate((before, values))
    assert running.mean == pytest.approx(together.mean(), abs=1e-9)
    assert running.deviation == pytest.approx(together.std(), abs=1e-9)


@given(st.lists(VALUES, max_size=6))
def test_bit_by_bit_is_as_at_once_while_nothing_is_forgotten(parts: list[np.ndarray]) -> None:
    bits, once = normal(most=1e6), normal(most=1e6)
    for part in parts:
        bits.add(part)
    once.add(np.concatenate([np.zeros(0), *parts]))
    assert (bits.mean, bits.deviation) == pytest.approx((once.mean, once.deviation), rel=1e-9)


def test_a_speaker_who_changes_is_followed() -> None:
    running = normal()
    for _ in range(40):
        running.add(np.array([9.0, 11.0] * 6))
    assert (running.mean, running.deviation) == pytest.approx((10.0, 1.0), abs=0.01)


def test_a_mean_that_is_hardly_known_gives_way_at_once() -> None:
    running = RunningNormal(90.0, 2.0, 0.2, 25.0, 25.0)
    running.add(np.array([80.0, 82.0, 81.0]))
    assert running.mean == pytest.approx(81.56, abs=0.01)
    assert 1.5 < running.deviation < 2.5


def test_the_range_of_an_unheard_speaker_is_the_usual_one() -> None:
    found = RunningRange(90.0, 1.0, 300.0).range
    usual = priors().range_
    assert (found.low, found.lower, found.upper, found.high) == pytest.approx(
        (90.0 + usual.low, 90.0 + usual.lower, 90.0 + usual.upper, 90.0 + usual.high)
    )


@given(st.floats(75.0, 105.0), st.floats(0.1, 4.0), st.integers(0, 5))
def test_the_range_becomes_that_of_the_frames(middle: float, deviation: float, seed: int) -> None:
    frames = np.random.default_rng(seed).normal(middle, deviation, 1_000)
    running = unknown_speaker().range
    for _ in range(12):
        running.add(frames)
    expected = np.percentile(np.clip(frames, 70.0, 110.0), [5, 25, 75, 95])
    found = running.range
    assert (found.low, found.lower, found.upper, found.high) == pytest.approx(tuple(expected), abs=0.15)
    # Frames that are only asked about are not counted.
    running.with_frames(frames + 9.0)
    assert running.range == found


def test_a_voice_is_known_before_it_speaks_and_a_speaker_is_not() -> None:
    voice, speaker = known_voice(200.0), unknown_speaker()
    low = np.full(5, 12.0 * np.log2(100.0))
    voice.pitch.add(low)
    speaker.pitch.add(low)
    assert voice.pitch.standard(low)[0] < -1.5
    assert abs(speaker.pitch.standard(low)[0]) < 0.3
