"""Ticks: whole at the usual rates, and times of events are equal however they are computed."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.core.movement import LipSegment, ManualCurve, Movement
from risorius.core.score import Score
from risorius.core.speech.utterance import Accent, Ending, Pause, PauseKind, Phone, Phrase, Syllable, Word
from risorius.core.time import TICKS_PER_SECOND, on_tick, on_ticks, seconds_of, ticks_of

DAY = 86_400
TICKS = st.integers(-DAY * TICKS_PER_SECOND, DAY * TICKS_PER_SECOND)


@pytest.mark.parametrize(
    "rate",
    [8_000, 11_025, 12_000, 16_000, 22_050, 24_000, 32_000, 44_100, 48_000, 88_200, 96_000, 176_400, 192_000],
)
def test_samples_are_whole_ticks(rate: int) -> None:
    assert TICKS_PER_SECOND % rate == 0
    samples = (1, 7, 12_345, DAY * rate - 1)
    assert [on_tick(k / rate) for k in samples] == [k / rate for k in samples]


@pytest.mark.parametrize("fps", [24, 25, 30, 48, 50, 60, 72, 75, 90, 96, 100, 120, 144, 240])
def test_frames_are_whole_ticks(fps: int) -> None:
    assert TICKS_PER_SECOND % fps == 0


@pytest.mark.parametrize("nominal", [24, 30, 60, 120])
def test_frames_of_television_are_whole_ticks(nominal: int) -> None:
    assert (TICKS_PER_SECOND / Fraction(1000 * nominal, 1001)).denominator == 1


def test_some_rates_are_not_whole() -> None:
    assert TICKS_PER_SECOND % 37_800
    assert abs(on_tick(1 / 37_800) - 1 / 37_800) <= 0.5 / TICKS_PER_SECOND


@given(TICKS)
def test_ticks_survive_seconds_and_back(ticks: int) -> None:
    assert ticks_of(seconds_of(ticks)) == ticks
    assert seconds_of(ticks) < seconds_of(ticks + 1)
    assert on_tick(seconds_of(ticks)) == seconds_of(ticks)


@given(TICKS, TICKS)
def test_sums_are_exact_in_ticks(a: int, b: int) -> None:
    assert ticks_of(seconds_of(a) + seconds_of(b)) == a + b
    assert ticks_of(seconds_of(a) - seconds_of(b)) == a - b


@given(st.floats(-DAY, DAY))
def test_the_nearest_tick_is_within_half_a_tick(seconds: float) -> None:
    assert abs(Fraction(seconds) - Fraction(ticks_of(seconds), TICKS_PER_SECOND)) <= Fraction(
        100_001, 200_000 * TICKS_PER_SECOND
    )
    assert on_ticks(np.array([seconds]))[0] == on_tick(seconds)


@pytest.mark.parametrize("seconds", [math.inf, -math.inf])
def test_infinite_times_stay(seconds: float) -> None:
    assert on_tick(seconds) == seconds
    assert on_ticks(np.array([seconds])).tolist() == [seconds]
    assert math.isnan(on_tick(math.nan))


def test_decimal_times_are_themselves() -> None:
    assert [on_tick(x) for x in (0.1, 0.3, 1.25, 12.345, 0.00001)] == [0.1, 0.3, 1.25, 12.345, 0.00001]


def test_events_that_were_added_up_differently_touch() -> None:
    start, end = 0.1 + 0.2, 0.3
    assert start != end
    assert (
        Phone("M", 0.0, end).end == Phone("AA", start, 1.0).start == Pause(start, 1.0, PauseKind.COMMA).start
    )
    assert Syllable(0, 1, start, 1.0, 0, 0).start == Word("a", end, 1.0, 0, 1, 0, 1).start
    assert Accent(start, 0, 0).time == Phrase(0, 1, end, 1.0, 0, Ending.OPEN).start


def test_movements_and_lip_segments_stand_on_ticks() -> None:
    start, end = 0.1 + 0.2, 0.3
    first = Movement("emotion", 0.0, end, 0.1 + 0.2, 1.0 / 3.0, {})
    second = Movement("emotion", start, 1.0, 0.3, 1.0 / 3.0 + 1e-11, {})
    assert (first.end, first.onset, first.offset) == (second.start, second.onset, second.offset)
    assert LipSegment("M", 0.0, end, {}).end == LipSegment("AA", start, 1.0, {}).start


def test_drawn_curves_and_the_end_of_a_score_stand_on_ticks() -> None:
    start, end = 0.1 + 0.2, 0.3
    keys = ((0.0, 0.5), (end, 0.25))
    assert ManualCurve({"masseter": keys}).keys["masseter"] is keys
    assert ManualCurve({"masseter": ((0.0, 0.5), (start, 0.25))}).keys == {"masseter": keys}
    assert Score(start).duration == Score(end).duration == end
