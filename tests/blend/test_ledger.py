"""The ledger: what every stage leaves of what channels request."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from risorius.blend.concatenate import SIGNED
from risorius.blend.plan import Plan, PlanSample
from risorius.core.movement import LipSegment, Movement
from risorius.core.score import BlendSettings, Score

from .strategies import DURATION, scores

JAW, ROUND, SMILE = "masseter", "orbicularis_oris_funneler", "zygomatic_major.left"
POLICIES = ("inhibit", "graded", "attenuate", "sum")
HAPPY = Movement("emotion", 0.0, 4.0, 0.4, 0.4, {SMILE: 0.8, JAW: 0.5})
VOWEL = LipSegment("UW", 1.0, 2.4, {ROUND: 0.9, JAW: 0.6}, {JAW: (0.0, 0.7)})
SCORE = Score(4.0, (HAPPY,), (VOWEL,), settings=BlendSettings(conflict="inhibit", lips="lookahead"))


def at_the_vowel(name: str) -> dict[str, tuple[float, ...]]:
    ledger = PlanSample(Plan(SCORE), np.array([1.7])).ledger(name)
    return {
        e.channel.name: tuple(float(v[0]) for v in (e.requested, e.resolved, e.shared, e.applied))
        for e in ledger.entries()
    }


def test_the_policy_takes_what_a_rival_inhibits() -> None:
    assert at_the_vowel(SMILE) == {"emotion": (0.8, 0.0, 0.0, 0.0)}


def test_a_jaw_shares_what_speech_leaves_and_keeps_within_the_limit() -> None:
    stages = at_the_vowel(JAW)
    assert stages["lips"] == pytest.approx((0.6, 0.6, 0.6, 0.6), abs=1e-9)
    requested, resolved, shared, applied = stages["emotion"]
    assert requested == resolved == 0.5
    assert shared == pytest.approx(0.5 * (1.0 - 0.6), abs=1e-9)
    assert applied == pytest.approx(0.7 - 0.6, abs=1e-9)


def test_a_parameter_that_nothing_moves_has_no_entries() -> None:
    ledger = PlanSample(Plan(SCORE), np.array([1.7])).ledger("tongue_up")
    assert list(ledger.entries()) == []
    assert ledger.speech.tolist() == [0.0]


@settings(max_examples=8, deadline=None)
@given(score=scores(), policy=st.sampled_from(POLICIES))
def test_no_stage_adds_anything(score: Score, policy: str) -> None:
    plan = Plan(Score(score.duration, score.movements, score.lips, settings=BlendSettings(conflict=policy)))
    sample = PlanSample(plan, np.linspace(0.0, DURATION, 57))
    for name in set(plan.moving) - SIGNED:
        for entry in sample.ledger(name).entries():
            stages = (entry.requested, entry.resolved, entry.shared, entry.applied)
            for before, after in pairwise(stages):
                assert (after <= before + 1e-12).all()  # weights of changing priorities sum to 1 by rounding
                assert (after >= 0.0).all()


def test_the_entry_of_a_channel_is_the_highest_of_its_curves() -> None:
    other = Movement("emotion", 1.0, 3.0, 0.2, 0.2, {SMILE: 1.0}, layer="other")
    plan = Plan(Score(4.0, (HAPPY, other)))
    ledger = PlanSample(plan, np.linspace(0.5, 3.5, 31)).ledger(SMILE)
    (channel,) = ledger.channels
    highest = np.zeros(31)
    for curve in channel.curves[SMILE]:
        entry = ledger.curve_entry(channel, curve)
        highest[entry.index] = np.maximum(highest[entry.index], entry.requested)
    entry = ledger.entry(channel)
    assert entry.requested.tolist() == highest[entry.index].tolist()
