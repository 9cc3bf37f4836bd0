import numpy as np
import pytest

from risorius.blend import Plan, suppression
from risorius.core.movement import Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score

SMILE, ROUND = "zygomatic_major.left", "orbicularis_oris_funneler"


def movement(channel, **targets):
    return Movement(channel, 0.0, 2.0, 0.2, 0.2, targets)


def at_one_second(*movements, conflict="inhibit"):
    score = Score(2.0, movements, settings=BlendSettings(conflict=conflict))
    return suppression(Plan(score), np.array([1.0]))[0]


def test_nothing_is_suppressed_without_rivals():
    assert (at_one_second(movement("emotion", **{SMILE: 0.8})) == 0).all()


def test_an_inhibited_smile_is_suppressed_whole():
    both = at_one_second(movement("emotion", **{SMILE: 0.8}), movement("signals", **{ROUND: 0.9}))
    assert both[INDEX[SMILE]] == pytest.approx(0.8)
    assert both[INDEX[ROUND]] == 0


def test_a_sum_suppresses_nothing():
    both = at_one_second(
        movement("emotion", **{SMILE: 0.8}), movement("signals", **{ROUND: 0.9}), conflict="sum"
    )
    assert (both == 0).all()


def test_many_times_give_as_many_rows():
    plan = Plan(Score(2.0, (movement("emotion", **{SMILE: 0.8}), movement("signals", **{ROUND: 0.9}))))
    assert suppression(plan, np.linspace(0, 2, 7)).shape == (7, len(INDEX))
    assert suppression(plan, np.zeros(0)).shape == (0, len(INDEX))
