"""Contact goals: closures that hold, and what happens where they collide."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius import blend
from risorius.blend.mouth.contact import SEAL, TUCK, GoalCurve, contact_goals
from risorius.blend.mouth.tradeoffs import tradeoffs
from risorius.core.lips.articulators import PROTRUSION, SHORTEST_CLOSURE
from risorius.core.movement import LipSegment, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score
from tests.profiles import examples

from ..strategies import DURATION, PHONES, scores

AT = np.arange(0, 3, 0.001)
RAMP = tradeoffs().seal.ramp


def sealed(start: float, end: float, value: float = 1.0) -> LipSegment:
    return LipSegment("M", start, end, {SEAL: value})


def tucked(start: float, end: float) -> LipSegment:
    return LipSegment("F", start, end, {TUCK: 1.0})


def curves(*segments: LipSegment) -> tuple[np.ndarray, np.ndarray]:
    goals = contact_goals(segments)
    seal, tuck = (GoalCurve([g for g in goals if g.contact == c]).at(AT) for c in (SEAL, TUCK))
    return seal, tuck


def between(start: float, end: float) -> np.ndarray:
    return (start <= AT) & (end >= AT)


class TestGoals:
    def test_full_for_the_whole_closure_and_nothing_beyond_the_ramps(self) -> None:
        seal, _ = curves(sealed(1.0, 1.1))
        assert (seal[between(1.0, 1.1)] == 1).all()
        assert (seal[~between(1.0 - RAMP, 1.1 + RAMP)] == 0).all()
        assert np.abs(np.diff(seal)).max() < 0.001 * 2 / RAMP

    def test_a_short_closure_is_lengthened_before_its_release(self) -> None:
        seal, _ = curves(sealed(1.0, 1.01))
        assert AT[seal == 1].max() == pytest.approx(1.01, abs=0.0015)
        assert (seal == 1).sum() * 0.001 == pytest.approx(SHORTEST_CLOSURE, abs=0.0015)

    def test_a_partial_goal(self) -> None:
        assert curves(sealed(1.0, 1.1, 0.4))[0].max() == 0.4

    def test_a_tuck_is_free_of_the_seal_beside_it(self) -> None:
        seal, tuck = curves(sealed(1.0, 1.1), tucked(1.15, 1.25), sealed(1.3, 1.4))
        held = between(1.1 + RAMP, 1.3 - RAMP)
        assert (tuck[held] == 1).all()
        assert (seal[held] == 0).all()
        assert (tuck[between(1.0, 1.1) | between(1.3, 1.4)] == 0).all()

    def test_a_seal_keeps_its_closure_where_they_touch(self) -> None:
        seal, tuck = curves(tucked(0.9, 1.0), sealed(1.0, 1.1), tucked(1.1, 1.2))
        closed = between(1.0, 1.1)
        assert (seal[closed] == 1).all()
        assert tuck[closed].max() < 1e-12
        assert (tuck[between(0.9, 1.0 - RAMP) | between(1.1 + RAMP, 1.2)] == 1).all()

    def test_a_tuck_between_closures_is_full_at_its_middle_at_least(self) -> None:
        _, tuck = curves(sealed(1.0, 1.1), tucked(1.1, 1.15), sealed(1.15, 1.2))
        assert tuck[between(1.1249, 1.1251)].max() == pytest.approx(1.0, abs=1e-9)

    def test_the_lip_leaves_the_teeth_earlier_if_the_upper_one_is_forward(self) -> None:
        around = (sealed(1.0, 1.05), rounded(1.1, 1.16), tucked(1.16, 1.2), sealed(1.2, 1.3))
        (tuck,) = (goal for goal in contact_goals(around) if goal.contact == TUCK)
        forward = tradeoffs().rounding.remaining * around[1].targets[PROTRUSION]
        assert (1.2 - tuck.end) * tradeoffs().opening.fastest == pytest.approx(tradeoffs().tuck.gap + forward)

    def test_a_tuck_without_room_is_given_up(self) -> None:
        _, tuck = curves(sealed(1.0, 1.1), tucked(1.1, 1.12), sealed(1.12, 1.2))
        assert not tuck.any()

    def test_a_tuck_waits_for_a_rounded_phone_on_either_side(self) -> None:
        free, waits = tuck_ramp(), tradeoffs().tuck.waits
        round_before, round_after = rounded(0.9, 1.0), rounded(1.1, 1.2)
        _, tuck = curves(round_before, tucked(1.0, 1.1), round_after)
        assert (tuck[~between(0.95, 1.15)] == 0).all()
        assert (tuck[between(0.951 + free, 1.149 - free)] == 1).all()
        _, tuck = curves(rounded(0.98, 1.0), tucked(1.0, 1.1), rounded(1.1, 1.12))
        assert (tuck[between(1.0 + waits * 0.1, 1.1 - waits * 0.1)] == 1).all()
        assert tuck[between(0.989, 0.991)].max() < 0.5


def tuck_ramp() -> float:
    return tradeoffs().tuck.ramp


def rounded(start: float, end: float) -> LipSegment:
    return LipSegment("UW", start, end, {"lip_protrusion": 3.0})


class TestCombined:
    """DESIGN, section 3: goals hold under every emotion, policy and model."""

    SURPRISE = Movement("emotion", 0.0, 3.0, 0.2, 0.2, {"masseter": 1.0, "levator_labii_nasi.left": 1.0})
    WORD = tuple(
        LipSegment(p, a, b, PHONES[p].targets, PHONES[p].limits, PHONES[p].dominance)
        for p, a, b in (
            ("AA", 0.5, 0.7),
            ("M", 0.7, 0.8),
            ("AA", 0.8, 1.0),
            ("M", 1.0, 1.08),
            ("F", 1.2, 1.3),
        )
    )

    @pytest.mark.parametrize("policy", ["inhibit", "graded", "attenuate", "sum"])
    @pytest.mark.parametrize("priority", [10.0, 90.0])
    def test_lips_are_shut_under_a_full_surprise(self, policy: str, priority: float) -> None:
        surprise = Movement("emotion", 0.0, 3.0, 0.2, 0.2, self.SURPRISE.targets, priority=priority)
        score = Score(3.0, (surprise,), self.WORD, settings=BlendSettings(conflict=policy))
        values = blend.at(score, AT)
        closed = between(0.7, 0.8) | between(1.0, 1.08)
        assert (values[closed, INDEX[SEAL]] == 1).all()
        assert values[closed, INDEX["masseter"]].max() <= 0.2 + 1e-12
        assert values[closed, INDEX["levator_labii_nasi.left"]].max() <= 0.1 + 1e-12
        assert (values[between(1.2, 1.3), INDEX[TUCK]] == 1).all()

    def test_the_jaw_comes_and_goes_no_faster_than_it_can(self) -> None:
        values = blend.at(Score(3.0, (self.SURPRISE,), self.WORD), AT)
        jaw = values[:, INDEX["masseter"]]
        assert np.abs(np.diff(jaw)).max() <= 0.001 * 2.2 / 0.12

    def test_switched_off(self) -> None:
        score = Score(3.0, (self.SURPRISE,), self.WORD, settings=BlendSettings(contact=False))
        values = blend.at(score, AT)
        assert not values[:, INDEX[SEAL]].any()
        assert not values[:, INDEX[TUCK]].any()
        assert values[between(0.7, 0.8), INDEX["masseter"]].min() > 0.2

    def test_other_channels_may_ask_for_contact_too(self) -> None:
        pressed = Movement("manipulators", 0.0, 1.0, 0.1, 0.1, {SEAL: 0.5, TUCK: 0.7})
        values = blend.at(Score(3.0, (pressed,), (sealed(0.5, 0.6),)), np.array([0.3, 0.55]))
        assert values[:, INDEX[SEAL]].tolist() == [0.5, 1.0]
        assert values[:, INDEX[TUCK]].tolist() == [0.7, 0.0]


@examples(40)
@given(score=st.one_of(scores("inhibit"), scores("graded"), scores("sum")))
def test_every_closure_holds(score: Score) -> None:
    for segment in score.lips:
        if SEAL in segment.targets and segment.end < DURATION:
            values = blend.at(score, np.linspace(segment.start, segment.end, 9))
            assert (values[:, INDEX[SEAL]] == 1).all()
            assert values[:, INDEX["masseter"]].max() <= 0.2 + 1e-9
