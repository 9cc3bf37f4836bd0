"""Explanations: what they say, and that they say it of the curves' own values."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.core.movement import Cause, LipSegment, ManualCurve, Movement
from risorius.core.parameters import INDEX, NAMES, NEUTRAL
from risorius.core.score import Score
from risorius.errors import InputError, ParameterError
from tests.profiles import examples

from .strategies import DURATION, scores

SMILE, ROUND, JAW = "zygomatic_major.left", "orbicularis_oris_funneler", "masseter"
HAPPY = Movement(
    "emotion",
    0.0,
    4.0,
    0.4,
    0.4,
    {SMILE: 0.8, JAW: 0.5},
    cause=Cause("emotion.happiness", "happiness 0.8", "a.xml:2:1"),
)
WORD = (
    LipSegment("AA", 1.0, 1.3, {JAW: 0.4}, cause=Cause("lips.AA", '/AA/ of "mom"')),
    LipSegment(
        "M", 1.3, 1.4, {"lip_seal": 1.0, JAW: 0.05}, {JAW: (0.0, 0.1)}, cause=Cause("lips.M", '/M/ of "mom"')
    ),
    LipSegment("UW", 2.0, 2.4, {ROUND: 0.9}, cause=Cause("lips.UW", '/UW/ of "who"')),
)
SCORE = Score(4.0, (HAPPY,), WORD)
PLAN = blend.Plan(SCORE)


class TestRefused:
    def test_an_unknown_parameter(self) -> None:
        with pytest.raises(ParameterError, match="did you mean"):
            blend.explain(SCORE, 1.0, "zygomatic_major.lefty")

    @pytest.mark.parametrize("time", [-0.1, 4.1, float("nan")])
    def test_a_time_outside(self, time: float) -> None:
        with pytest.raises(InputError, match="expected 0 to 4 s"):
            blend.explain(SCORE, time, SMILE)


class TestWords:
    def test_a_winner_and_its_cause(self) -> None:
        found = blend.explain(PLAN, 0.7, SMILE)
        assert found.winner is not None
        assert found.winner.cause == HAPPY.cause
        assert found.winner.applied == found.value == 0.8
        assert found.losers == ()

    def test_inhibited(self) -> None:
        found = blend.explain(PLAN, 2.2, SMILE)
        assert found.winner is None
        assert found.losers[0].reason == f'inhibited by {ROUND} of /UW/ of "who" (lips)'

    def test_limited_by_the_minimum_durations(self) -> None:
        before, after = (blend.explain(PLAN, t, SMILE).winner for t in (1.9, 2.6))
        assert before is not None
        assert after is not None
        assert before.reason == f'limited by its minimum offset before {ROUND} of /UW/ of "who" (lips)'
        assert after.reason == f'limited by its minimum onset after {ROUND} of /UW/ of "who" (lips)'

    def test_limited_by_a_phone(self) -> None:
        jaw = blend.explain(PLAN, 1.35, JAW)
        reason = next(p.reason for p in (jaw.winner, *jaw.losers) if p is not None and p.channel == "emotion")
        assert reason == 'adds only a share to the jaw of speech; limited by /M/ of "mom"'

    def test_lower(self) -> None:
        weak = Movement("signals", 0.0, 4.0, 0.1, 0.1, {SMILE: 0.3}, id="weak")
        found = blend.explain(Score(4.0, (HAPPY, weak)), 2.0, SMILE)
        assert [(p.label, p.reason) for p in found.losers] == [("weak", "lower than happiness 0.8 (emotion)")]

    def test_contact(self) -> None:
        found = blend.explain(PLAN, 1.35, "lip_seal")
        assert found.winner is not None
        assert found.winner.what == '/M/ of "mom"'
        assert found.value == 1.0

    def test_a_tail_goes_back_to_what_it_is_the_tail_of(self) -> None:
        follower = Movement("emotion", 1.0, 3.0, 0.1, 0.1, {"frontalis_medialis.left": 0.5})
        slow = Movement("emotion", 0.0, 2.0, 0.5, 1.0, {SMILE: 0.9}, id="slow")
        found = blend.explain(Score(4.0, (slow, follower)), 1.3, SMILE)
        assert found.winner is not None
        assert found.winner.label == "slow"

    def test_drawn_by_hand(self) -> None:
        drawn = ManualCurve({SMILE: ((0.0, 0.3), (1.0, 0.3))}, Cause("manual", "curve 1"))
        found = blend.explain(Score(1.0, manual=(drawn,)), 0.5, SMILE)
        assert found.winner is not None
        assert (found.winner.channel, found.winner.what) == ("manual", "curve 1")

    def test_directions_add(self) -> None:
        turns = tuple(Movement(c, 0.0, 2.0, 0.1, 0.1, {"head_yaw": 10.0}, id=c) for c in ("head", "emotion"))
        found = blend.explain(Score(2.0, turns), 1.0, "head_yaw")
        assert found.winner is not None
        assert [p.reason for p in (found.winner, *found.losers)] == ["added, made smaller by the others"] * 2
        assert found.value == pytest.approx(sum(p.applied for p in (found.winner, *found.losers)))


@examples(20)
@given(data=st.data(), policy=st.sampled_from(("inhibit", "graded", "attenuate", "sum")))
def test_the_value_is_the_curves_and_follows_from_the_parts(data: st.DataObject, policy: str) -> None:
    plan = blend.Plan(data.draw(scores(policy)))
    time = data.draw(st.floats(0, DURATION))
    values = plan.at(np.array([0.0, time, DURATION]))[1]
    for name in plan.moving:
        found = blend.explain(plan, time, name)
        value = values[INDEX[name]]
        assert found.value == pytest.approx(value, abs=1e-9)
        contributions = [p for p in (found.winner, *found.losers) if p is not None]
        assert all(p.reason for p in found.losers)
        assert all(
            p.reason
            for p in contributions
            if abs(p.applied) < abs(p.requested) - 1e-9 and p.channel != "lips"
        )
        if (
            name != JAW
            and not found.notes
            and policy != "sum"
            and name not in ("head_pitch", "gaze_distance")
        ):
            largest: dict[str, float] = {}
            for part in contributions:
                largest[part.channel] = max(part.applied, largest.get(part.channel, 0.0))
            # Paper B adds the channels; no parameter goes beyond its end.
            together = sum(largest.values()) if policy == "attenuate" else max(largest.values(), default=0.0)
            assert value == pytest.approx(min(together, 1.0), abs=1e-8)


def test_every_frame_can_be_explained() -> None:
    performance = blend.combine(SCORE, Fraction(30))
    for frame, time in enumerate(performance.times):
        for name in (SMILE, ROUND, JAW, "lip_seal", "lip_tuck", "head_yaw"):
            found = blend.explain(PLAN, float(time), name)
            assert found.value == pytest.approx(performance.values[frame, INDEX[name]], abs=1e-9)
            assert (found.winner is not None) == (abs(found.value - NEUTRAL[INDEX[name]]) > 1e-9)


def test_summary() -> None:
    tallies = blend.summarize(SCORE, Fraction(30))
    happy, lips = tallies["emotion"], tallies["lips"]
    assert happy.active == 2 * 119
    assert 10 < happy.inhibited < 20
    assert happy.limited > 10
    assert lips.inhibited == 0
    assert lips.won > 20
    assert len(NAMES) == 46
