"""Curves drawn by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from risorius import blend
from risorius.core.arrays import Array
from risorius.core.movement import LipSegment, ManualCurve, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score


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
