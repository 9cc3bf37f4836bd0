"""Where plans can differ: outside the span that is named their curves are the same to the last bit."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from risorius.blend import Plan, changed_span
from risorius.core.edits import Add, Delete, Keys, Move, Retarget, Stretch, edited, identified
from risorius.core.movement import LipSegment, Movement
from risorius.core.score import BlendSettings, Score
from risorius.errors import RisoriusError
from tests.profiles import examples

DURATION = 40.0
FPS = Fraction(30)
SMILE = {"zygomatic_major.left": 0.8, "zygomatic_major.right": 0.8, "masseter": 0.3}
BROWS = {"frontalis_medialis.left": 0.9, "levator_labii_nasi.left": 0.7}
TURN = {"head_yaw": 12.0, "head_pitch": -4.0}
FUNNELER = "orbicularis_oris_funneler"
POUT = {FUNNELER: 0.9, "mentalis.left": 0.5}


def a_score(conflict):
    """Return speech all through, a smile now and then, brows, and a head that never rests."""
    lips = tuple(
        LipSegment(
            phone,
            0.4 * k,
            0.4 * k + 0.4,
            {"masseter": 0.1 * (k % 4), "orbicularis_oris_funneler": 0.2 * (k % 3)},
        )
        for k, phone in enumerate("ABCDE" * 20)
    )
    movements = [
        *(Movement("emotion", 5.0 * k, 5.0 * k + 3.5, 0.45, 0.75, SMILE) for k in range(8)),
        *(Movement("signals", 3.0 * k + 1.0, 3.0 * k + 2.0, 0.1, 0.2, BROWS) for k in range(12)),
        *(Movement("head", 1.0 * k, 1.0 * k + 1.2, 0.6, 0.3, TURN) for k in range(38)),
        Movement("manipulators", 12.0, 17.0, 0.3, 0.4, POUT),
        Movement("manipulators", 13.0, 15.0, 0.3, 0.4, {"risorius.left": 0.9}),
    ]
    return identified(Score(DURATION, tuple(movements), lips, settings=BlendSettings(conflict=conflict)))


PLANS = {name: Plan(a_score(name)) for name in ("inhibit", "graded", "attenuate", "sum")}
TAKES = {name: plan.performance(FPS) for name, plan in PLANS.items()}
start = st.floats(0.0, 39.0)
names = st.sampled_from([m.id for m in PLANS["sum"].score.movements])
targets = st.sampled_from([SMILE, BROWS, TURN, POUT])
edits = st.one_of(
    st.builds(Move, names, start),
    st.builds(Stretch, names, st.none(), st.none(), st.floats(0.0, 1.0), st.floats(0.0, 2.0)),
    st.builds(Retarget, names, targets),
    st.builds(lambda a, b: Add("emotion", a, a + b, POUT), start, st.floats(0.2, 8.0)),
    st.builds(lambda a, b: Add("signals", a, a + b, SMILE, layer=""), start, st.floats(0.2, 8.0)),
    st.builds(Delete, names),
    st.builds(
        lambda a, b, over: Keys("zygomatic_major.left", ((a, 0.2), (a + b, 0.9)), over),
        start, st.floats(0.1, 1.0), st.booleans(),
    ),
)  # fmt: skip


@pytest.mark.parametrize("policy", PLANS)
@examples(15)
@given(st.lists(edits, min_size=1, max_size=2))
def test_what_lies_outside_is_the_same_and_a_performance_of_the_rest_is_the_whole(policy, some):
    plan, score = PLANS[policy], PLANS[policy].score
    try:
        for edit in some:
            score = edited(score, edit)
    except RisoriusError:
        assume(False)
    other = Plan(score, like=plan)
    span = changed_span(plan, other)
    assert span is not None
    like = other.performance_like(TAKES[policy], span)
    assert np.array_equal(like.values, other.performance(FPS).values)
    assert changed_span(other, plan) == span


def test_a_change_is_felt_nearby_only():
    plan = PLANS["graded"]
    block = next(m.id for m in plan.score.movements if m.channel == "signals" and m.start > 20.0)
    begin, end = changed_span(plan, Plan(edited(plan.score, Move(block, 22.5)), like=plan))
    assert 15.0 < begin < 22.0
    assert 23.5 < end < 30.0
    assert changed_span(plan, Plan(replace(plan.score, text="other"), like=plan)) == (0.0, 0.0)


def test_what_cannot_be_told_is_not():
    plan = PLANS["graded"]
    block = plan.score.movements[0].id
    others = (
        replace(plan.score, lips=plan.score.lips[:-1]),
        replace(plan.score, duration=39.0),
        replace(plan.score, settings=BlendSettings("graded", min_onset=0.1)),
        edited(plan.score, Retarget(block, priority=65.0)),
    )
    for score in others:
        assert changed_span(plan, Plan(score, like=plan)) is None


def test_layers_of_the_same_movements_are_shared_and_no_others():
    plan = Plan(a_score("graded"))
    block = next(m for m in plan.score.movements if m.channel == "emotion")
    rest = tuple(m for m in plan.score.movements if m is not block)
    moved = Plan(replace(plan.score, movements=(*rest, replace(block, end=block.end - 0.05))), like=plan)
    channels = {movement.channel for movement in plan.score.movements}
    assert len(channels) > 1
    for channel in channels:
        for key, layer in plan.layers.of(channel).items():
            changed = (channel, key) == ("emotion", (block.on_top, block.layer))
            assert (moved.layers.of(channel)[key] is layer) is not changed
    other = replace(plan.score, settings=replace(plan.score.settings, onset_function="linear"))
    assert Plan(other, like=plan).layers.of("emotion").values() != plan.layers.of("emotion").values()


def test_what_speech_leaves_of_a_request_goes_with_the_request():
    closed = {"masseter": (0.0, 0.05)}
    lips = tuple(LipSegment("BA"[k % 2], 0.2 * k, 0.2 * k + 0.2, {}, [closed, {}][k % 2]) for k in range(10))
    less, more = (
        Score(2.0, (Movement("emotion", 0.0, 2.0, 0.1, 0.1, {"masseter": jaw}),), lips) for jaw in (0.2, 0.9)
    )
    times = np.arange(0.0, 2.0, 0.01)
    before = Plan(less)
    before.at(times)
    np.testing.assert_array_equal(Plan(more, None, before).at(times), Plan(more).at(times))
