"""Movements of one layer: invalid scores, each case of the formulas, laws against the slow reference."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend.concatenate import concatenate, sequence
from risorius.blend.curve_pieces import MovementCurve
from risorius.core.functions import ONSET_FUNCTIONS
from risorius.core.movement import Movement
from tests.profiles import examples

from . import reference
from .strategies import MUSCLES, movements

Z = "zygomatic_major.left"


def move(start: float, end: float, onset: float, offset: float, value: float, **more: object) -> Movement:
    return Movement("emotion", start, end, onset, offset, {Z: value}, **more)  # type: ignore[arg-type]


def values(found: list[Movement], times: np.ndarray, name: str = Z) -> np.ndarray:
    curve = concatenate(found).curves[name]
    dense = np.zeros(len(times))
    index, sampled = curve.sample(times)
    dense[index] = sampled
    return dense


def test_both_sides_share_what_is_the_same() -> None:
    one = Movement("emotion", 0, 2, 0.5, 0.5, {Z: 0.5, Z.replace("left", "right"): 0.5})
    curves = concatenate([one, move(3, 4, 0.1, 0.1, 0.2)]).curves
    assert curves[Z] is not curves[Z.replace("left", "right")]
    curves = concatenate([one]).curves
    assert curves[Z] is curves[Z.replace("left", "right")]


class TestOneMovement:
    """Paper A, section 4."""

    def test_figure_4(self) -> None:
        found = values([move(0, 7, 2, 3, 1.0)], np.array([0, 1, 2, 3, 4, 5.5, 7, 8.0]))
        assert found == pytest.approx([0, math.sqrt(2) - 1, 1, 1, 1, math.sqrt(2) - 1, 0, 0], abs=1e-15)

    def test_zero_onset_and_offset_are_steps(self) -> None:
        found = values([move(1, 2, 0, 0, 0.7)], np.array([0.999, 1.0, 1.5, 2.0, 2.001]))
        assert found.tolist() == [0, 0.7, 0.7, 0.7, 0]

    def test_onset_and_offset_too_long_shrink_in_proportion(self) -> None:
        short = move(0, 1, 1.0, 3.0, 1.0)
        times = np.linspace(0, 1, 101)
        assert values([short], times) == pytest.approx(values([move(0, 1, 0.25, 0.75, 1.0)], times))
        assert values([short], np.array([0.25])) == pytest.approx([1.0])


class TestTwoMovements:
    """Paper A, section 5.2; facts: science/errata, A1 and A2."""

    def test_figure_5_releases_to_a_lower_target(self) -> None:
        found = [move(0, 7, 2, 3, 1.0), move(3, 10, 2, 2, 0.5)]
        xi = 3 * (1 - math.log2(1.5))
        times = np.array([3.0, 3.5, 3 + 3 - xi, 7.0, 9.0])
        expected = [1.0, 0.5 + 2 ** (1 - (0.5 + xi) / 3) - 1, 0.5, 0.5, 0.5 * (math.sqrt(2) - 1)]
        assert values(found, times) == pytest.approx(expected, abs=1e-12)

    def test_rise_meets_a_higher_target_early(self) -> None:
        found = [move(0, 7, 2, 3, 0.3), move(3, 10, 2, 2, 0.9)]
        xi = 2 * math.log2(1.6)
        times = np.array([3.0, 3 + xi / 2, 3 + xi, 5.0, 8.0])
        assert values(found, times) == pytest.approx([0.3, 0.3 + 2 ** (xi / 4) - 1, 0.9, 0.9, 0.9], abs=1e-12)

    def test_release_from_the_top_is_the_first_movements_own(self) -> None:
        first = move(0, 7, 2, 3, 1.0)
        second = Movement("emotion", 5, 12, 2, 2, {"masseter": 0.2})
        times = np.linspace(5, 7, 50)
        assert values([first, second], times) == pytest.approx(values([first], times), abs=1e-14)

    @pytest.mark.parametrize(
        ("one", "two"),
        [
            (move(0, 7, 2, 3, 1.0), move(3, 10, 2, 2, 0.5)),
            (move(0, 7, 2, 2, 1.0), move(3, 10, 2, 2, 0.0)),
            (move(0, 7, 2, 3, 1.0), move(5, 12, 2, 2, 0.2)),
            (move(0, 7, 2, 3, 0.3), move(3, 10, 2, 2, 0.9)),
            (move(0, 7, 2, 3, 1.0), move(3, 4.5, 0.3, 0.4, 0.5)),
        ],
    )
    def test_cases_of_the_errata(self, one: Movement, two: Movement) -> None:
        """The printed case (2) starts elsewhere, rises, and jumps; ours starts where movement 1 stands."""
        times = np.arange(0, 13, 1e-4)
        got = values([one, two], times)
        until = times <= two.start
        assert got[until] == pytest.approx(values([one], times[until]), abs=1e-14)
        assert np.abs(np.diff(got)).max() < 2.5e-4
        onset = (times > two.start) & (times <= two.start + two.onset)
        falls = got[until][-1] >= two.targets[Z]
        assert (np.diff(got[onset]) <= 0).all() if falls else (np.diff(got[onset]) >= 0).all()
        steady = (times >= two.start + max(two.onset, one.offset)) & (times <= two.end - two.offset)
        assert got[steady] == pytest.approx(np.full(steady.sum(), two.targets[Z]), abs=1e-12)

    def test_release_longer_than_the_next_onset_has_no_jump(self) -> None:
        found = [move(0, 7, 2, 3, 1.0), move(3, 4.5, 0.3, 0.4, 0.5)]
        steps = np.abs(np.diff(values(found, np.arange(0, 8, 1e-4))))
        assert steps.max() < 2.5e-4

    def test_touching_movements_do_not_overlap(self) -> None:
        one, two = move(0, 2, 0.5, 0.5, 1.0), move(2, 4, 0.5, 0.5, 0.6)
        times = np.linspace(0, 4, 401)
        assert values([one, two], times) == pytest.approx(values([one], times) + values([two], times))

    def test_a_tail_that_outlasts_its_follower_counts_as_overlap(self) -> None:
        found = [
            move(0, 4, 1, 4, 1.0),
            Movement("emotion", 1, 1.5, 0.1, 0.1, {"masseter": 1.0}),
            move(2, 4, 1, 1, 0.2),
        ]
        late = values(found, np.array([2.0 - 1e-9, 2.0, 2.0 + 1e-9]))
        assert late[0] > 0.2
        assert np.ptp(late) < 1e-8

    def test_zero_durations_switch_at_once(self) -> None:
        found = [move(0, 3, 0, 0, 1.0), move(1, 4, 0, 0, 0.4)]
        assert values(found, np.array([0.5, 1.0, 3.5, 4.5])).tolist() == [1.0, 0.4, 0.4, 0.0]


class TestNested:
    """A movement within another interrupts it."""

    def test_the_outer_resumes_where_the_inner_lets_go(self) -> None:
        steps = sequence([move(0, 10, 1, 1, 1.0), move(3, 5, 0.5, 0.5, 0.2)])
        assert [(s.start, s.end) for s in steps] == [(0, 10), (3, 5), (4.5, 10)]

    def test_an_outer_with_no_time_left_is_dropped(self) -> None:
        steps = sequence([move(0, 5.4, 1, 1, 1.0), move(3, 5, 0.5, 0.5, 0.2)])
        assert [(s.start, s.end) for s in steps] == [(0, 5.4), (3, 5)]

    def test_two_deep(self) -> None:
        steps = sequence([move(0, 10, 1, 1, 1.0), move(2, 8, 0.5, 0.5, 0.6), move(3, 5, 0.5, 0.5, 0.2)])
        assert [(s.start, s.end) for s in steps] == [(0, 10), (2, 8), (3, 5), (4.5, 8), (7.5, 10)]

    def test_a_third_that_outlasts_the_inner_takes_its_place(self) -> None:
        steps = sequence([move(0, 10, 1, 1, 1.0), move(2, 4, 0.5, 0.5, 0.6), move(3, 5, 0.5, 0.5, 0.2)])
        assert [(s.start, s.end) for s in steps] == [(0, 10), (2, 4), (3, 5), (4.5, 10)]

    def test_one_that_outlasts_all_ends_all(self) -> None:
        steps = sequence([move(0, 10, 1, 1, 1.0), move(2, 4, 0.5, 0.5, 0.6), move(3, 12, 0.5, 0.5, 0.2)])
        assert [(s.start, s.end) for s in steps] == [(0, 10), (2, 4), (3, 12)]


class TestSigned:
    """Degrees go straight from where they are to where they are asked."""

    def test_from_one_side_to_the_other(self) -> None:
        found = [
            Movement("head", 0, 4, 1, 1, {"head_yaw": 10.0}),
            Movement("head", 2, 6, 1, 1, {"head_yaw": -20.0}),
        ]
        got = values(found, np.array([1.5, 2.5, 3.0, 5.5]), "head_yaw")
        assert got == pytest.approx([10, 10 - 30 * (math.sqrt(2) - 1), -20, -20 * (math.sqrt(2) - 1)])

    def test_distance_is_worked_from_its_neutral(self) -> None:
        found = [Movement("gaze", 0, 4, 1, 1, {"gaze_distance": 2.8})]
        assert values(found, np.array([2.0]), "gaze_distance") == pytest.approx([2.0])

    def test_what_the_next_movement_lacks_returns_within_its_onset(self) -> None:
        found = [
            Movement("head", 0, 4, 1, 1, {"head_yaw": 10.0}),
            Movement("head", 2, 6, 1, 1, {"head_pitch": 5.0}),
        ]
        got = values(found, np.array([2.0, 2.5, 3.0, 3.5]), "head_yaw")
        assert got == pytest.approx([10, 10 - 10 * (math.sqrt(2) - 1), 0, 0])


@pytest.mark.parametrize("function", ONSET_FUNCTIONS.names())
@examples(40)
@given(found=movements(("emotion",), most=6))
def test_agrees_with_the_reference(function: str, found: tuple[Movement, ...]) -> None:
    layer = [reference.with_function(m, function) for m in found if m.layer == ""]
    times = np.arange(0, 9, 0.0371)
    result = concatenate(layer)
    names = sorted({name for m in layer for name in m.targets})
    for name in names:
        signed = name in ("head_pitch", "gaze_distance")
        shifted = [
            replace(m, targets={k: v - 0.8 * (k == "gaze_distance") for k, v in m.targets.items()})
            for m in layer
        ]
        expected = reference.curve(shifted, name, signed, times)
        got = np.zeros(len(times))
        index, sampled = result.curves[name].sample(times)
        got[index] = sampled
        # A speed is measured over a moment: within it a movement may come to rest, or numbers be rounded.
        exactness = {"exponential": 1e-12, "linear": 1e-12, "saccade": 4e-3}.get(function, 1e-3)
        assert got == pytest.approx(np.array(expected), abs=exactness)


@examples(60)
@given(found=movements(("emotion",), most=6, directions=False), threshold=st.sampled_from((0.0, 0.1, 0.5)))
def test_above_finds_exactly_the_times_over_the_threshold(
    found: tuple[Movement, ...], threshold: float
) -> None:
    layer = concatenate([m for m in found if m.layer == ""])
    times = np.arange(0.003, 9, 0.0137)
    for name in MUSCLES:
        curve = layer.curves.get(name)
        if curve is not None:
            _check_above(curve, threshold, times)


def _check_above(curve: MovementCurve, threshold: float, times: np.ndarray) -> None:
    spans = curve.above(threshold)
    assert (np.diff(spans.ravel()) > 0).all()
    dense = np.zeros(len(times))
    index, sampled = curve.sample(times)
    dense[index] = sampled
    inside = ((times[:, None] > spans[:, 0]) & (times[:, None] < spans[:, 1])).any(axis=1)
    near = np.abs(dense - threshold) < 1e-9
    assert ((dense > threshold) == inside)[~near].all()


@pytest.mark.parametrize("name", ["zygomatic_major.left", "head_pitch"])
@pytest.mark.parametrize("second", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("start", [0.1, 0.2, 0.75])
def test_smooth_movements_follow_one_another_without_a_corner(name: str, second: float, start: float) -> None:
    layer = [
        Movement("emotion", at, at + 0.8, 0.3, 0.3, {name: value}, function="minimum_jerk")
        for at, value in ((0.05, 0.6), (start, second))
    ]
    bends = []
    for step in (0.01, 0.0025):
        values = np.zeros(round(1.8 / step))
        index, sampled = concatenate(layer).curves[name].sample(np.arange(len(values)) * step)
        values[index] = sampled
        bends.append(np.abs(np.diff(values, 2)).max())
    assert bends[0] >= 8.0 * bends[1]
    assert 0.0 <= values.min() <= values.max() <= 1.0
