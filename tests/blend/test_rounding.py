"""Rounding: no corner in what `speak` makes, and none taken away from what is meant to have some."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.blend.plan import Plan
from risorius.blend.rounding import SmoothingWindow
from risorius.core.arrays import Array
from risorius.core.movement import ManualCurve, Movement
from risorius.core.parameters import INDEX, NAMES
from risorius.core.score import BlendSettings, Score
from tests.profiles import examples

SMILE, BROW = "zygomatic_major.left", "frontalis_medialis.left"
ROUNDED = BlendSettings("graded", rounding=0.02)
TWO = (
    Movement("emotion", 0.0, 2.0, 0.4, 0.4, {SMILE: 0.5}, function="minimum_jerk"),
    Movement("signals", 0.5, 1.5, 0.2, 0.2, {SMILE: 0.9}, function="minimum_jerk"),
)
"""Two movements in whose maximum there are two corners."""
SCORE = Score(2.5, TWO, settings=ROUNDED)


def second_difference(score: Score, fps: int, name: str = SMILE) -> float:
    curve = blend.at(score, np.arange(0.0, score.duration, 1 / fps))[:, INDEX[name]]
    return float(np.abs(np.diff(curve, 2)).max())


def test_corners_are_rounded_off() -> None:
    sharp = replace(SCORE, settings=replace(ROUNDED, rounding=0.0))
    assert second_difference(sharp, 100) < 5 * second_difference(sharp, 400)
    assert second_difference(SCORE, 100) > 8 * second_difference(SCORE, 400)


@pytest.mark.parametrize("top", [0.503, 0.55, 0.66])
def test_a_quick_raise_of_the_brows_that_stands_out_has_no_corners(top: float) -> None:
    """It takes over from another and ends within the time over which corners are rounded."""
    quick = replace(TWO[1], start=0.712, onset=0.09, targets={BROW: top})
    score = replace(SCORE, movements=(replace(TWO[0], targets={BROW: 0.5}), quick))
    assert second_difference(score, 100, BROW) > 8 * second_difference(score, 400, BROW)


@pytest.mark.parametrize(
    "movements",
    [
        [replace(m, function="exponential") for m in TWO],
        [replace(m, function="linear") for m in TWO],
        [replace(TWO[0], onset=0.0), TWO[1]],
    ],
    ids=["exponential", "linear", "D = 0"],
)
def test_what_is_sharp_on_purpose_stays_so(movements: list[Movement]) -> None:
    times = np.linspace(0.0, 2.5, 501)
    score = Score(2.5, tuple(movements), settings=ROUNDED)
    sharp = replace(score, settings=replace(ROUNDED, rounding=0.0))
    assert (blend.at(score, times) == blend.at(sharp, times)).all()


def test_a_function_for_all_movements_counts_for_each() -> None:
    linear = replace(SCORE, settings=replace(ROUNDED, onset_function="linear"))
    assert Plan(linear).rounding.exact(SMILE, np.array([1.0])).all()


def test_a_curve_drawn_by_hand_goes_through_its_keys() -> None:
    drawn = ManualCurve({SMILE: ((0.8, 0.1), (1.0, 0.95), (1.2, 0.1))}, replaces=True)
    found = blend.at(replace(SCORE, manual=(drawn,)), np.array([1.0]))
    assert found[0, INDEX[SMILE]] == 0.95


@examples(30)
@given(
    values=st.lists(st.floats(0.0, 1.0), min_size=4, max_size=4),
    width=st.floats(0.001, 0.1),
)
def test_an_average_lies_between_what_it_is_made_of(values: list[float], width: float) -> None:
    knots, times = np.linspace(0.0, 1.0, 4), np.linspace(0.0, 1.0, 41)
    around = SmoothingWindow(times, width, 1.0)
    read: Array = np.interp(around.times, knots, values)
    average = around.average(read)
    assert average.min() >= min(values) - 1e-15
    assert average.max() <= max(values) + 1e-15
    assert (around.average(np.full(len(around.times), values[0])) == values[0]).all()
    assert np.abs(average - np.interp(times, knots, values)).max() <= 3.0 * width + 1e-9


def test_values_do_not_depend_on_the_other_times() -> None:
    times = np.linspace(0.0, 2.5, 76)
    together = blend.at(SCORE, times)
    alone = np.concatenate([blend.at(SCORE, times[i : i + 1]) for i in range(0, 76, 5)])
    assert together[::5] == pytest.approx(alone, abs=1e-12)


def test_the_explanation_says_where_a_curve_was_rounded() -> None:
    times = np.arange(0.5, 0.9, 0.0025)
    sharp = replace(SCORE, settings=replace(ROUNDED, rounding=0.0))
    change = np.abs(blend.at(SCORE, times) - blend.at(sharp, times))[:, INDEX[SMILE]]
    corner = blend.explain(SCORE, float(times[change.argmax()]), SMILE)
    assert "rounded over 20 ms" in corner.notes
    assert not blend.explain(SCORE, 1.0, SMILE).notes


def test_lids_and_eyes_are_rounded_less() -> None:
    widths = {name: Plan(SCORE).rounding.width(name) for name in NAMES}
    quick = {name for name, width in widths.items() if width == 0.005}
    assert {"levator_palpebrae.left", "orbicularis_oculi_palpebralis.left", "gaze_yaw"} <= quick
    unrounded = {name for name, width in widths.items() if width == 0.0}
    assert {name.partition("_")[0] for name in unrounded} == {"tongue"}
    assert all(widths[name] == 0.02 for name in NAMES if name not in quick | unrounded)
