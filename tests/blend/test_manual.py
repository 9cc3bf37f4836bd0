"""Curves drawn by hand."""

from __future__ import annotations

import numpy as np
import pytest

from risorius import blend
from risorius.core.movement import LipSegment, ManualCurve
from risorius.core.parameters import INDEX
from risorius.core.score import Score


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
