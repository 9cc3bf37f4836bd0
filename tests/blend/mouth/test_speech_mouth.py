"""The lips' limits on other channels, and the jaw that they share."""

from __future__ import annotations

import numpy as np
import pytest

from risorius import blend
from risorius.core.movement import Dominance, LipSegment, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import BlendSettings, Score

UP, JAW = "levator_labii_superioris.left", "masseter"
PRESS = "orbicularis_oris_presser"
TIMES = np.arange(0, 4, 0.001)


def curve(score: Score, name: str, times: np.ndarray = TIMES) -> np.ndarray:
    return blend.at(score, times)[:, INDEX[name]]


def held(name: str, value: float, channel: str = "emotion", **more: object) -> Movement:
    return Movement(channel, 0.0, 4.0, 0.0, 0.0, {name: value}, **more)  # type: ignore[arg-type]


def phone(
    start: float, end: float, high: float, name: str = UP, low: float = 0.0, **targets: float
) -> LipSegment:
    return LipSegment("V", start, end, targets, {name: (low, high)})


class TestLimits:
    def test_reached_in_the_phone_and_gone_far_from_it(self) -> None:
        values = curve(Score(4.0, (held(UP, 0.9),), (phone(1.0, 1.5, 0.2),)), UP)
        assert values[1250] == pytest.approx(0.2, abs=0.01)
        assert (values[[300, 2500]] == 0.9).all()

    def test_come_and_go_no_faster_than_the_minimum_durations(self) -> None:
        values = curve(Score(4.0, (held(UP, 1.0),), (phone(1.0, 1.5, 0.0),)), UP)
        assert np.abs(np.diff(values)).max() <= 0.001 / 0.25 + 1e-9

    def test_are_diluted_by_neighbours_but_not_at_a_closure(self) -> None:
        around = [LipSegment("AA", 0.9, 1.0, {}), LipSegment("AA", 1.08, 1.2, {})]
        plain = LipSegment("V", 1.0, 1.08, {}, {UP: (0.0, 0.1)})
        closing = LipSegment("M", 1.0, 1.08, {"lip_seal": 1.0}, {UP: (0.0, 0.1)})
        at = np.linspace(1.0, 1.08, 9)
        quick = BlendSettings(min_onset=0.01, min_offset=0.01)
        loose = curve(Score(4.0, (held(UP, 0.9),), (*around, plain), settings=quick), UP, at)
        tight = curve(Score(4.0, (held(UP, 0.9),), (*around, closing), settings=quick), UP, at)
        assert loose.max() > 0.2
        assert tight == pytest.approx(np.full(9, 0.1), abs=1e-9)

    def test_do_not_bind_speech_itself(self) -> None:
        segment = LipSegment("M", 1.0, 2.0, {PRESS: 0.6}, {PRESS: (0.0, 0.1)})
        assert curve(Score(4.0, (), (segment,)), PRESS)[1500] == pytest.approx(0.6, abs=0.01)

    def test_of_silence_do_not_count(self) -> None:
        silence = LipSegment("", 1.0, 2.0, {}, {UP: (0.0, 0.1)})
        assert (curve(Score(4.0, (held(UP, 0.9),), (silence,)), UP) == 0.9).all()

    def test_a_channel_that_outranks_speech_is_bound_by_closures_only(self) -> None:
        segments = (
            phone(0.5, 1.0, 0.2),
            LipSegment("M", 2.0, 2.5, {"lip_seal": 1.0}, {UP: (0.0, 0.1)}),
        )
        values = curve(Score(4.0, (held(UP, 0.9, priority=80.0),), segments), UP)
        assert values[750] == pytest.approx(0.9)
        assert values[2250] == pytest.approx(0.1)

    def test_a_suppressed_rival_suppresses_nothing(self) -> None:
        smile = held("zygomatic_major.left", 0.8)
        sneer = held(UP, 0.9, channel="signals")
        values = curve(Score(4.0, (smile, sneer), (phone(1.0, 3.0, 0.05),)), "zygomatic_major.left")
        assert values[2000] == pytest.approx(0.8)
        assert values[3900] == 0.0

    def test_a_lower_limit_holds_up(self) -> None:
        score = Score(4.0, (), (phone(1.0, 2.0, 1.0, JAW, low=0.3),))
        assert curve(score, JAW)[1500] == pytest.approx(0.3, abs=0.01)


class TestJaw:
    def test_others_open_their_part_of_the_way_that_speech_leaves(self) -> None:
        speech = LipSegment("AA", 1.0, 3.0, {JAW: 0.3})
        values = curve(Score(4.0, (held(JAW, 0.6),), (speech,)), JAW)
        assert values[2000] == pytest.approx(0.3 + 0.6 * 0.7, abs=0.01)
        assert values[200] == pytest.approx(0.6)

    def test_limits_hold_for_the_total(self) -> None:
        speech = LipSegment("AA", 1.0, 3.0, {JAW: 0.3}, {JAW: (0.0, 0.4)})
        assert curve(Score(4.0, (held(JAW, 1.0),), (speech,)), JAW)[2000] == pytest.approx(0.4, abs=0.01)

    def test_half_a_drop_comes_back_in_half_the_time(self) -> None:
        closed = LipSegment("M", 1.0, 1.1, {"lip_seal": 1.0}, {JAW: (0.0, 0.0)})
        open_ = LipSegment("AA", 1.1, 3.0, {})
        risen = []
        for asked in (0.5, 1.0):
            values = curve(Score(4.0, (held(JAW, asked),), (closed, open_)), JAW)[1100:]
            risen.append(int(np.argmax(values >= 0.98 * asked)))
        assert risen[0] == pytest.approx(risen[1] / 2.0, abs=15)

    def test_what_is_left_between_closures_has_no_corner(self) -> None:
        closed = [LipSegment("M", t, t + 0.08, {"lip_seal": 1.0}, {JAW: (0.0, 0.1)}) for t in (1.0, 1.3, 1.6)]
        values = curve(Score(4.0, (held(JAW, 0.35),), tuple(closed)), JAW)[900:1800]
        speed = np.diff(values)
        assert values.max() > 0.2 > 0.1 + 1e-9 > values.min()
        assert np.abs(np.diff(speed)).max() < 0.35 * np.abs(speed).max()

    def test_silence_leaves_them_all(self) -> None:
        silence = LipSegment("", 1.0, 3.0, {}, {}, {"*": Dominance(1.0, 0.08, 0.08)})
        assert curve(Score(4.0, (held(JAW, 0.6),), (silence,)), JAW) == pytest.approx(np.full(4000, 0.6))

    def test_an_overwhelming_emotion_takes_it(self) -> None:
        speech = LipSegment("AA", 1.0, 3.0, {JAW: 0.1}, {JAW: (0.0, 0.4)})
        values = curve(Score(4.0, (held(JAW, 0.8, priority=90.0),), (speech,)), JAW)
        assert values[2000] == pytest.approx(0.9, abs=0.01)


def test_without_segments_the_jaw_goes_to_the_higher() -> None:
    chewing = held(JAW, 0.3, channel="lips")
    assert curve(Score(4.0, (chewing, held(JAW, 0.6))), JAW, np.array([2.0])).tolist() == [0.6]


def test_movements_may_stand_in_the_lips_channel_too() -> None:
    lick = Movement("lips", 1.0, 2.0, 0.1, 0.1, {"tongue_out": 0.7, "orbicularis_oris_funneler": 0.2})
    speech = LipSegment("UW", 0.5, 2.5, {"orbicularis_oris_funneler": 0.9})
    values = blend.at(Score(4.0, (lick,), (speech,)), np.array([1.5]))
    assert values[0, INDEX["tongue_out"]] == pytest.approx(0.7)
    assert values[0, INDEX["orbicularis_oris_funneler"]] == pytest.approx(0.9, abs=0.01)
