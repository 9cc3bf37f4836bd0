"""Random numbers by key: the same whatever else is asked for, and as evenly spread as random ones."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.counter_rng import CounterRng, Key

MANY = 20_000
KEYS = st.lists(st.one_of(st.text(max_size=4), st.integers()), max_size=4).map(tuple)
SEEDS = st.integers(-(2**70), 2**70)


def test_a_choice_among_nothing_is_refused() -> None:
    with pytest.raises(ValueError, match="empty"):
        CounterRng(0).choice({})


@given(SEEDS, KEYS, KEYS)
def test_a_number_does_not_depend_on_those_asked_for_before(
    seed: int, key: tuple[Key, ...], other: tuple[Key, ...]
) -> None:
    numbers = CounterRng(seed)
    numbers.uniform(*other)
    numbers.under(*other).normal()
    assert numbers.uniform(*key) == CounterRng(seed).uniform(*key)


@given(SEEDS, KEYS, KEYS, KEYS)
def test_a_key_may_be_given_in_parts(
    seed: int, first: tuple[Key, ...], second: tuple[Key, ...], third: tuple[Key, ...]
) -> None:
    whole = CounterRng(seed).uniform(*first, *second, *third)
    assert CounterRng(seed, *first).under(*second).uniform(*third) == whole


@given(SEEDS, KEYS, SEEDS, KEYS)
def test_other_keys_and_seeds_have_other_numbers(
    seed: int, key: tuple[Key, ...], other_seed: int, other: tuple[Key, ...]
) -> None:
    same = (seed, key) == (other_seed, other)
    assert (CounterRng(seed).uniform(*key) == CounterRng(other_seed).uniform(*other)) == same


@pytest.mark.parametrize(
    ("one", "other"), [(("a", "b"), ("ab",)), (("a,b",), ("a", "b")), ((1, 2), (12,)), ((1,), ("1",))]
)
def test_keys_that_look_alike_are_told_apart(one: tuple[Key, ...], other: tuple[Key, ...]) -> None:
    assert CounterRng(0).uniform(*one) != CounterRng(0).uniform(*other)


def test_numbers_are_those_of_every_machine_and_version() -> None:
    numbers = CounterRng(0, "head.noise")
    assert numbers.uniform("dwell", 3) == 0.9091085540524492
    assert numbers.normal("pitch", 3) == pytest.approx(-1.220089379694642, rel=1e-12)
    assert numbers.exponential() == pytest.approx(2.130396463938531, rel=1e-12)
    assert numbers.choice({"up": 0.2, "down": 0.1, "side": 0.7}, "way") == "side"


def test_uniform_numbers_fill_their_range_evenly() -> None:
    drawn = np.array([CounterRng(1).uniform("x", number, low=-1.0, high=3.0) for number in range(MANY)])
    assert -1.0 <= drawn.min() < drawn.max() < 3.0
    counts, _ = np.histogram(drawn, bins=20, range=(-1.0, 3.0))
    # Deviations of a count of one in twenty among 20,000: 31.
    assert np.abs(counts - MANY / 20).max() < 4 * 31


def test_normal_numbers_have_their_mean_deviation_and_limit() -> None:
    drawn = np.array([CounterRng(1).normal(number, mean=2.0, deviation=0.5) for number in range(MANY)])
    assert drawn.mean() == pytest.approx(2.0, abs=0.015)
    assert drawn.std() == pytest.approx(0.5, rel=0.02)
    assert np.mean(np.abs(drawn - 2.0) < 0.5) == pytest.approx(0.6827, abs=0.015)
    limited = [CounterRng(1).normal(number, mean=2.0, deviation=0.5, limit=2.0) for number in range(MANY)]
    np.testing.assert_array_equal(limited, np.clip(drawn, 1.0, 3.0))


def test_exponential_numbers_have_a_mean_and_deviation_of_one() -> None:
    drawn = np.array([CounterRng(1).exponential(number) for number in range(MANY)])
    assert drawn.min() >= 0.0
    assert drawn.mean() == pytest.approx(1.0, abs=0.03)
    assert drawn.std() == pytest.approx(1.0, abs=0.05)


def test_choices_follow_their_weights() -> None:
    weights = {"up": 0.58, "down": 0.0, "side": 1.42}
    drawn = Counter(CounterRng(1).choice(weights, number) for number in range(MANY))
    assert drawn.keys() == {"up", "side"}
    assert drawn["up"] / MANY == pytest.approx(0.29, abs=0.015)


@pytest.mark.parametrize("step", [1, 2, 256])
def test_numbers_of_neighbouring_counts_are_independent(step: int) -> None:
    drawn = np.array([CounterRng(0).uniform("x", number) for number in range(0, step * 5000, step)])
    assert abs(np.corrcoef(drawn[:-1], drawn[1:])[0, 1]) < 0.05
