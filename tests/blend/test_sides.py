"""Sides that move alike are computed once, and no others are taken for each other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from risorius.blend.plan import Plan
from risorius.core.movement import LipSegment, ManualCurve, Movement
from risorius.core.score import Score
from tests.profiles import examples

from .strategies import DURATION, scores

BROW, SMILE, FROWN, CHIN = "frontalis_lateralis", "zygomatic_major", "triangularis", "mentalis"


def movement(*names: str, start: float = 0.0) -> Movement:
    targets = {f"{name}.{side}": 0.5 for name in names for side in ("left", "right")}
    return Movement("emotion", start, 1.0, 0.2, 0.2, targets)


def test_what_moves_on_both_sides_is_computed_once() -> None:
    plan = Plan(Score(2.0, (movement(BROW, SMILE),)))
    assert plan.twins[f"{SMILE}.right"] == f"{SMILE}.left"
    assert plan.twins[f"{BROW}.right"] == f"{BROW}.left"


ONE_SIDED = Movement("signals", 0.5, 1.5, 0.2, 0.2, {f"{FROWN}.left": 0.7})


def test_a_rival_on_one_side_tells_the_sides_apart() -> None:
    plan = Plan(Score(2.0, (movement(BROW, SMILE), ONE_SIDED)))
    assert f"{SMILE}.right" not in plan.twins
    assert f"{BROW}.right" in plan.twins


@pytest.mark.parametrize(
    "score",
    [
        Score(2.0, (movement(SMILE),), manual=(ManualCurve({f"{SMILE}.left": ((0.0, 0.0), (1.0, 0.3))}),)),
        Score(2.0, (movement(SMILE),), (LipSegment("IY", 0.2, 0.6, {f"{SMILE}.left": 0.3}),)),
        Score(2.0, (movement(CHIN),), (LipSegment("IY", 0.2, 0.6, {}, limits={f"{CHIN}.left": (0.0, 0.3)}),)),
    ],
    ids=["drawn by hand", "a phone's target", "a phone's limit"],
)
def test_other_differences_tell_the_sides_apart(score: Score) -> None:
    twins = Plan(score).twins
    assert f"{SMILE}.right" not in twins
    assert f"{CHIN}.right" not in twins


@examples(25)
@given(score=scores("graded"))
def test_no_value_changes(score: Score) -> None:
    plan, each = Plan(score), Plan(score)
    each.twins = {}
    times = np.linspace(0.0, DURATION, 60)
    assert (plan.at(times) == each.at(times)).all()
