"""Curves on knots: ramps at an even pace, curves that change no faster than they may, and without corners."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from risorius.blend.knots import (
    BLOCK,
    STEEPEST,
    Knots,
    KnotWindow,
    block_knots,
    inverse_ramp,
    ramp,
    rate_limited,
    slowed_clock,
    smooth_interp,
    split_blocks,
)

KNOTS = np.array([0.0, 0.004, 0.009, 0.0135, 0.0185, 0.0225])
SHARES = arrays(np.float64, 60, elements=st.floats(0.0, 1.0))
STEPS = arrays(np.float64, 60, elements=st.floats(0.001, 0.01))
WIDTH = 0.04


def test_a_ramp_goes_from_0_to_1_and_rests_at_both_ends() -> None:
    values = ramp(np.linspace(0.0, 1.0, 1001))
    speed = np.diff(values) * 1000.0
    assert (values[0], values[500], values[-1]) == (0.0, 0.5, 1.0)
    assert speed.max() == pytest.approx(STEEPEST)
    assert max(speed[0], speed[-1]) < 0.01


@given(values=arrays(np.float64, len(KNOTS), elements=st.floats(0.0, 1.0)))
def test_a_curve_along_knots_turns_about_them_without_corners(values: np.ndarray) -> None:
    times = np.linspace(-0.002, 0.0245, 26501)
    curve, lines = smooth_interp(times, KNOTS, values), np.interp(times, KNOTS, values)
    middles = (KNOTS[1:] + KNOTS[:-1]) / 2.0
    assert smooth_interp(middles, KNOTS, values) == pytest.approx(
        np.interp(middles, KNOTS, values), abs=1e-12
    )
    assert curve.min() >= values.min() - 1e-12
    assert curve.max() <= values.max() + 1e-12
    assert np.abs(curve - lines).max() <= np.abs(np.diff(values)).max() / 4.0 + 1e-12
    inside = (times[1:-1] > KNOTS[0] + 2e-6) & (times[1:-1] < KNOTS[-1] - 2e-6)
    # A corner would turn by up to 1 in 4 ms within a step of a microsecond.
    assert np.abs(np.diff(curve, 2))[inside].max() <= 1e-3 * np.abs(np.diff(lines, 2)).max() + 1e-12


@given(share=SHARES)
def test_a_ramp_is_undone_and_what_is_whole_stays_whole(share: np.ndarray) -> None:
    assert ramp(inverse_ramp(share)) == pytest.approx(share, abs=1e-12)
    assert ramp(inverse_ramp(np.array([0.0, 1.0]))).tolist() == [0.0, 1.0]


@given(share=SHARES, steps=STEPS)
def test_an_eased_curve_keeps_below_and_within_its_pace(share: np.ndarray, steps: np.ndarray) -> None:
    times = np.cumsum(steps)
    found = rate_limited(times, share, 0.2, 0.1)
    speed = np.diff(found) / np.diff(times)
    assert (found <= share + 1e-9).all()
    assert speed.max() <= 1.0 / 0.2 + 1e-6
    assert speed.min() >= -1.0 / 0.1 - 1e-6


def test_a_change_takes_little_longer_than_the_minimum() -> None:
    times = np.linspace(0.0, 1.0, 1001)
    found = rate_limited(times, np.where(times < 0.5, 0.0, 1.0), 0.2, 0.1)
    assert found[500] == pytest.approx(0.0, abs=1e-3)
    assert found[500 + round(200 * STEEPEST) + 1] == pytest.approx(1.0, abs=1e-6)


@given(share=SHARES, requested=SHARES, steps=STEPS)
def test_what_is_asked_comes_and_goes_within_its_pace(
    share: np.ndarray, requested: np.ndarray, steps: np.ndarray
) -> None:
    times = np.cumsum(steps)
    change = np.diff(rate_limited(slowed_clock(times, requested), share, 0.2, 0.1)) / np.diff(times)
    most = np.maximum(requested[1:], requested[:-1])
    assert (most * change <= 1.0 / 0.2 + 1e-6).all()
    assert (most * change >= -1.0 / 0.1 - 1e-6).all()


def test_a_share_of_half_changes_in_half_the_time_and_of_nothing_not_at_once() -> None:
    times = np.linspace(0.0, 1.0, 11)
    assert slowed_clock(times, np.full(11, 0.5)) == pytest.approx(2.0 * times)
    assert slowed_clock(times, np.zeros(11)) == pytest.approx(4.0 * times)
    assert slowed_clock(times, np.ones(11)) == pytest.approx(times)


@given(share=SHARES, steps=STEPS)
def test_the_lowest_of_all_times_around(share: np.ndarray, steps: np.ndarray) -> None:
    times = np.cumsum(steps)
    near = np.abs(times[:, None] - times) <= WIDTH / 2.0 + 1e-9
    lowest = KnotWindow(times, WIDTH).lowest(share)
    assert (lowest == np.where(near, share, np.inf).min(axis=1)).all()


def test_a_rounded_curve_has_no_corner_and_is_exact_where_it_is_even() -> None:
    times = np.linspace(0.0, 1.0, 501)
    corner = 0.9 - np.abs(times - 0.5).clip(0.0, 0.3)
    found = KnotWindow(times, WIDTH).average(corner)
    assert (found[times < 0.17] == corner[times < 0.17]).all()
    assert np.abs(np.diff(found, 2)).max() < 0.2 * np.abs(np.diff(corner, 2)).max()


@given(share=SHARES, steps=STEPS)
def test_rounded_after_the_lowest_is_not_above_the_curve(share: np.ndarray, steps: np.ndarray) -> None:
    times = np.cumsum(steps)
    around = KnotWindow(times, WIDTH)
    assert (around.average(around.lowest(share)) <= share + 1e-12).all()


@given(start=st.floats(0.0, 60.0), last=st.floats(100.0, 20_000.0))
def test_the_knots_of_a_block_do_not_grow_with_a_stretch_that_leaves_it(start: float, last: float) -> None:
    knots = Knots(np.array([0.0, start + 1.0, last]), 0.005)
    block = block_knots(knots, 1, 2.0)
    assert len(block) < 3.5 * BLOCK / 0.005
    assert block[0] <= BLOCK - 2.0
    assert min(2.0 * BLOCK + 2.0, last) <= block[-1]
    every = knots.between(0.0, last)
    near = every[: np.searchsorted(every, block[-1] + 0.01)]  # millions come after
    assert np.isin(block.round(9), near.round(9)).all()


def test_times_lie_in_the_parts_that_hold_them() -> None:
    times = np.array([-0.5, 1.0, 59.0, 60.0, 89.9, 150.0])
    found = [(number, times[place].tolist()) for number, place in split_blocks(times, 30.0)]
    assert found == [(-1, [-0.5]), (0, [1.0]), (1, [59.0]), (2, [60.0, 89.9]), (5, [150.0])]
    assert list(split_blocks(times[1:2], 30.0)) == [(0, slice(0, 1))]
    assert list(split_blocks(times[:0], 30.0)) == []
