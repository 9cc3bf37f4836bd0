"""Curves drawn by hand."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.core.arrays import Array
from risorius.core.key_shapes import Handle, KeyShape
from risorius.core.movement import LipSegment, ManualCurve, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score, check_score
from risorius.errors import InputError
from risorius.ports.score.score_json import read_score_file, score_to_json


def test_keys_are_joined_by_lines_and_hold_only_within_their_time() -> None:
    drawn = ManualCurve({"frontalis_medialis.left": ((1.0, 0.2), (2.0, 0.8), (3.0, 0.0))})
    values = blend.at(Score(4.0, manual=(drawn,)), np.array([0.99, 1.0, 1.5, 2.5, 3.5]))
    assert values[:, INDEX["frontalis_medialis.left"]] == pytest.approx([0, 0.2, 0.5, 0.4, 0])


def test_they_outrank_speech() -> None:
    drawn = ManualCurve({"zygomatic_major.left": ((0.0, 0.6), (2.0, 0.6))})
    rounded = LipSegment("UW", 0.5, 1.5, {"orbicularis_oris_funneler": 0.9})
    values = blend.at(Score(2.0, (), (rounded,), (drawn,)), np.array([1.0]))
    assert values[0, INDEX["zygomatic_major.left"]] == pytest.approx(0.6)
    assert values[0, INDEX["orbicularis_oris_funneler"]] == 0.0


def test_directions_are_drawn_as_they_are() -> None:
    drawn = ManualCurve({"gaze_distance": ((0.0, 2.0), (2.0, 4.0)), "head_yaw": ((0.0, -10.0), (2.0, 10.0))})
    values = blend.at(Score(2.0, manual=(drawn,)), np.array([0.5]))
    assert values[0, INDEX["gaze_distance"]] == pytest.approx(2.5)
    assert values[0, INDEX["head_yaw"]] == pytest.approx(-5.0)


def test_a_single_key_holds_for_its_instant() -> None:
    drawn = ManualCurve({"masseter": ((1.0, 0.5),)})
    values = blend.at(Score(2.0, manual=(drawn,)), np.array([0.9, 1.0, 1.1]))
    assert values[:, INDEX["masseter"]].tolist() == [0, 0.5, 0]


def test_two_drawn_curves_of_one_parameter_join_by_the_higher() -> None:
    low = ManualCurve({"masseter": ((0.0, 0.2), (2.0, 0.2))})
    high = ManualCurve({"masseter": ((1.0, 0.5), (2.0, 0.5))})
    values = blend.at(Score(2.0, manual=(low, high)), np.array([0.5, 1.5]))
    assert values[:, INDEX["masseter"]].tolist() == [0.2, 0.5]


class TestReplacing:
    SMILE = "zygomatic_major.left"
    HAPPY = Movement("emotion", 0.0, 4.0, 0.5, 0.5, {SMILE: 0.8, "head_pitch": 10.0})
    LOW = ManualCurve({SMILE: ((1.0, 0.8), (2.0, 0.1), (3.0, 0.8))}, replaces=True)

    def at(self, *times: float, **parts: object) -> Array:
        score = Score(4.0, (self.HAPPY,), **{"manual": (self.LOW,), **parts})  # type: ignore[arg-type]
        return blend.at(score, np.array(times))

    def test_a_curve_can_be_drawn_lower(self) -> None:
        values = self.at(0.9, 1.0, 2.0, 3.0, 3.1)
        assert values[:, INDEX[self.SMILE]] == pytest.approx([0.8, 0.8, 0.1, 0.8, 0.8])

    def test_without_it_the_higher_shows(self) -> None:
        values = self.at(2.0, manual=(replace(self.LOW, replaces=False),))
        assert values[0, INDEX[self.SMILE]] == pytest.approx(0.8)

    def test_a_direction_is_drawn_as_it_is(self) -> None:
        drawn = ManualCurve({"head_pitch": ((1.0, 10.0), (2.0, -5.0))}, replaces=True)
        values = self.at(0.9, 2.0, 2.1, manual=(drawn,))
        assert values[:, INDEX["head_pitch"]] == pytest.approx([10.0, -5.0, 10.0])

    def test_what_is_replaced_inhibits_nothing(self) -> None:
        rounded = LipSegment("UW", 0.5, 3.5, {"orbicularis_oris_funneler": 0.9})
        flat = ManualCurve({"orbicularis_oris_funneler": ((0.0, 0.0), (4.0, 0.0))}, replaces=True)
        assert self.at(2.0, lips=(rounded,), manual=())[0, INDEX[self.SMILE]] == 0.0
        assert self.at(2.0, lips=(rounded,), manual=(flat,))[0, INDEX[self.SMILE]] == pytest.approx(0.8)

    def test_contact_goals_hold_under_it(self) -> None:
        closed = LipSegment("M", 1.5, 2.5, {"lip_seal": 1.0})
        open_ = ManualCurve({"lip_seal": ((0.0, 0.0), (4.0, 0.0))}, replaces=True)
        assert self.at(2.0, lips=(closed,), manual=(open_,))[0, INDEX["lip_seal"]] == pytest.approx(1.0)

    @pytest.mark.parametrize("name", [SMILE, "head_pitch"])
    def test_it_is_explained_and_traced(self, name: str) -> None:
        drawn = ManualCurve({name: ((1.0, 0.1), (3.0, 0.1))}, replaces=True)
        plan = blend.Plan(Score(4.0, (self.HAPPY,), manual=(drawn,)))
        told = blend.explain(plan, 2.0, name)
        assert told.winner is not None
        assert told.winner.label == "drawn by hand"
        assert [part.reason for part in told.losers] == ["replaced by the curve drawn by hand"]
        manual, emotion = blend.traces(plan, name, np.array([0.8, 2.0]))
        assert (manual.channel, emotion.channel) == ("manual", "emotion")
        assert emotion.requested[1] == pytest.approx(self.HAPPY.targets[name])
        assert emotion.inhibited == ((1, 1),)


@pytest.mark.parametrize("conflict", ["inhibit", "graded", "attenuate"])
def test_every_policy_has_a_drawn_curve_replace(conflict: str) -> None:
    settings = BlendSettings(conflict=conflict)
    values = blend.at(
        Score(4.0, (TestReplacing.HAPPY,), manual=(TestReplacing.LOW,), settings=settings), np.array([2.0])
    )
    assert values[0, INDEX[TestReplacing.SMILE]] == pytest.approx(0.1)


BROW = "frontalis_medialis.left"


def shaped(*shapes: KeyShape, keys: tuple[tuple[float, float], ...] = ((1.0, 0.2), (2.0, 0.8))) -> Score:
    return Score(4.0, manual=(ManualCurve({BROW: keys}, replaces=True, shapes={BROW: shapes}),))


@pytest.mark.parametrize(
    ("shapes", "message"),
    [
        ((KeyShape(),), "1 shapes; expected one for each of its 2 keys"),
        ((KeyShape(after=(-0.1, 0.0)), KeyShape()), "shape 0 has handles"),
        ((KeyShape(), KeyShape(before=(0.1, 0.0))), "shape 1 has handles"),
        ((KeyShape(after=(math.nan, 0.0)), KeyShape()), "expected \\[seconds, value\\]"),
        ((KeyShape(after=(0.1, math.inf)), KeyShape()), "expected \\[seconds, value\\]"),
    ],
)
def test_shapes_that_are_not_those_of_the_keys_are_refused(
    shapes: tuple[KeyShape, ...], message: str
) -> None:
    with pytest.raises(InputError, match=message):
        check_score(shaped(*shapes))


def test_a_key_that_is_held_keeps_its_value_until_the_next() -> None:
    values = blend.at(shaped(KeyShape(hold=True), KeyShape()), np.array([1.0, 1.5, 1.999, 2.0]))
    np.testing.assert_allclose(values[:, INDEX[BROW]], [0.2, 0.2, 0.2, 0.8])


def test_level_handles_ease_in_and_out_and_straight_ones_change_nothing() -> None:
    times = np.linspace(1.0, 2.0, 41)
    level = shaped(KeyShape(after=(1 / 3, 0.0)), KeyShape(before=(-1 / 3, 0.0)))
    eased = blend.at(level, times)[:, INDEX[BROW]]
    share = times - 1.0
    np.testing.assert_allclose(eased, 0.2 + 0.6 * share**2 * (3 - 2 * share), atol=1e-4)
    straight = blend.at(shaped(KeyShape(), KeyShape()), times)
    third = shaped(KeyShape(after=(1 / 3, 0.2)), KeyShape(before=(-1 / 3, -0.2)))
    np.testing.assert_allclose(blend.at(third, times), straight, atol=1e-12)


@given(st.tuples(st.floats(0, 9), st.floats(-9, 9)), st.tuples(st.floats(-9, 0), st.floats(-9, 9)))
def test_whatever_the_handles_the_curve_stays_in_its_range_and_meets_its_keys(
    after: Handle, before: Handle
) -> None:
    score = shaped(KeyShape(after=after), KeyShape(before=before))
    values = blend.at(score, np.linspace(1.0, 2.0, 101))[:, INDEX[BROW]]
    assert values.min() >= 0.0
    assert values.max() <= 1.0
    np.testing.assert_allclose(values[[0, -1]], [0.2, 0.8])


def test_a_score_keeps_its_shapes(tmp_path: Path) -> None:
    score = shaped(KeyShape(after=(0.1, 0.2)), KeyShape(before=(-0.3, 0.0), hold=True))
    path = tmp_path / "a.score.json"
    path.write_text(json.dumps(score_to_json(score)))
    assert read_score_file(path).score.manual == score.manual
