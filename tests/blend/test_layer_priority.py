"""Rivals within a channel: paper A, section 2, by the policy that decides between channels."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from risorius.blend import Plan, combine, explain
from risorius.core.antagonists import antagonist_pairs, without_antagonists
from risorius.core.movement import Movement
from risorius.core.score import BlendSettings, Score

SMILE, CORNERS = "zygomatic_major.left", "triangularis.left"
FPS = Fraction(50)


def layer(name: str, start: float, targets: dict[str, float], end: float = 6.0) -> Movement:
    return Movement("emotion", start, end, 0.5, 0.5, targets, name, layer=name)


def performed(*movements: Movement, policy: str = "inhibit") -> dict[str, np.ndarray]:
    return combine(Score(8.0, movements, settings=BlendSettings(conflict=policy)), FPS).curves


def test_rivals_in_one_movement_sum_to_one_at_most() -> None:
    assert without_antagonists({SMILE: 1.0, CORNERS: 1.0}) == {SMILE: 1.0, CORNERS: 0.0}
    assert without_antagonists({SMILE: 0.3, CORNERS: 0.9}) == {SMILE: pytest.approx(0.1), CORNERS: 0.9}
    assert without_antagonists({SMILE: 0.5, CORNERS: 0.5}) == {SMILE: 0.5, CORNERS: 0.5}
    assert list(antagonist_pairs({SMILE: 1.0, "triangularis.right": 1.0})) == []
    curves = performed(layer("both", 1.0, {SMILE: 1.0, CORNERS: 1.0}))
    assert curves[SMILE].max() == 1.0
    assert curves[CORNERS].max() == 0.0


def test_the_layer_that_starts_later_wins() -> None:
    curves = performed(layer("a", 0.0, {SMILE: 0.8}), layer("b", 2.0, {CORNERS: 0.7}, 4.0))
    assert curves[SMILE][round(50 * 1.5)] == 0.8
    assert curves[SMILE][round(50 * 3.0)] == 0.0
    assert curves[CORNERS][round(50 * 3.0)] == 0.7
    assert curves[SMILE][round(50 * 5.0)] == 0.8
    assert np.abs(np.diff(curves[SMILE])).max() < 0.2


def test_of_two_that_start_together_the_larger_wins_then_the_later_in_the_score() -> None:
    curves = performed(layer("b", 1.0, {SMILE: 0.9}), layer("a", 1.0, {CORNERS: 0.6}))
    assert (curves[SMILE][150], curves[CORNERS][150]) == (0.9, 0.0)
    one, other = layer("b", 1.0, {SMILE: 0.6}), layer("a", 1.0, {CORNERS: 0.6})
    assert performed(one, other)[CORNERS][150] == 0.6
    assert performed(other, one)[SMILE][150] == 0.6


@pytest.mark.parametrize(("policy", "left"), [("graded", 0.0), ("attenuate", 0.8 * (1 - 0.8 * 0.7))])
def test_other_policies_decide_as_between_channels(policy: str, left: float) -> None:
    curves = performed(layer("a", 0.0, {SMILE: 0.8}), layer("b", 2.0, {CORNERS: 0.7}, 5.0), policy=policy)
    assert curves[SMILE][round(50 * 3.5)] == pytest.approx(left)


def test_layers_that_are_no_rivals_stay_together() -> None:
    score = Score(8.0, (layer("a", 0.0, {SMILE: 0.8}), layer("b", 2.0, {"frontalis_medialis.left": 0.7})))
    assert [c.key for c in Plan(score).channels] == ["emotion"]
    apart = replace(score, movements=(layer("a", 0.0, {SMILE: 0.8}, 1.0), layer("b", 2.0, {CORNERS: 0.7})))
    assert [c.key for c in Plan(apart).channels] == ["emotion"]


def test_channels_of_the_same_priority_still_do_not_inhibit_a_stratum() -> None:
    other = Movement("gaze", 0.0, 8.0, 0.5, 0.5, {CORNERS: 1.0}, "other", priority=10.0)
    curves = performed(layer("a", 0.0, {SMILE: 0.8}), layer("b", 2.0, {CORNERS: 0.7}, 4.0), other)
    assert curves[SMILE][round(50 * 1.0)] == 0.8


def test_explanations_name_the_layer_that_wins() -> None:
    score = Score(8.0, (layer("a", 0.0, {SMILE: 0.8}), layer("b", 2.0, {CORNERS: 0.7}, 4.0)))
    found = explain(score, 3.0, SMILE)
    assert found.winner is None
    assert found.losers[0].reason == "inhibited by triangularis.left of b (emotion)"
