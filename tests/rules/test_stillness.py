"""Movements of the head rise and fall in speech, and are held through pauses."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.rules.gestures import gesture_parts, gesture_seconds, timed_parts
from risorius.rules.markup import markup_table
from risorius.rules.stillness import (
    StillTime,
    after_pauses,
    begun_in_speech,
    between_pauses,
    next_pause,
)
from risorius.rules.synchrony import MovementPhases, lasting, synchrony

SWING = MovementPhases(1.0, 1.3, 1.5, 2.0)


def comma(start: float, end: float) -> StillTime:
    return StillTime(start, end, ends=False)


def stop(start: float, end: float = 9.0) -> StillTime:
    return StillTime(start, end, ends=True)


def test_a_movement_far_from_a_pause_stays_as_it_is() -> None:
    assert between_pauses(SWING, ()) == SWING
    assert between_pauses(SWING, (comma(0.2, 0.9), stop(5.0))) == SWING
    assert begun_in_speech(SWING, 0.1, (comma(0.2, 0.9),)) == SWING


@pytest.mark.parametrize(
    ("pause", "expected"),
    [
        (comma(1.9, 2.1), MovementPhases(1.0, 1.3, 1.4, 1.9)),  # its hold is shorter, and its fall is over
        (comma(1.6, 1.8), MovementPhases(1.0, 1.3, 1.8, 2.3)),  # it falls after the pause
        (comma(1.35, 1.45), MovementPhases(1.0, 1.3, 1.5, 2.0)),  # it holds anyway
        (comma(1.2, 1.4), MovementPhases(1.0, 1.2, 1.5, 2.0)),  # it rises sooner
        (comma(1.1, 1.2), MovementPhases(1.2, 1.5, 1.7, 2.2)),  # it has no time, and begins after the pause
        (stop(1.75), MovementPhases(1.0, 1.225, 1.375, 1.75)),  # all is hurried
        (stop(1.1), MovementPhases(1.0, 1.12, 1.2, 1.4)),  # but not beyond measure
    ],
)
def test_rises_and_falls_meet_no_pause(pause: StillTime, expected: MovementPhases) -> None:
    found = between_pauses(SWING, (pause,))
    assert [found.start, found.apex, found.release, found.end] == pytest.approx(
        [expected.start, expected.apex, expected.release, expected.end]
    )


def test_a_fall_that_is_over_before_a_pause_does_not_begin_before_another() -> None:
    found = between_pauses(MovementPhases(1.0, 1.3, 1.8, 2.6), (comma(1.4, 1.6), stop(2.2)))
    assert (found.release, found.end) == pytest.approx((1.6, 2.2))


@given(st.lists(st.floats(1.0, 4.0), min_size=2, max_size=8, unique=True), st.booleans())
def test_what_has_time_moves_in_no_pause(times: list[float], ends: bool) -> None:
    pauses = [comma(a, b) for a, b in list(pairwise(sorted(times)))[::2]]
    known = [*pauses, stop(4.5)] if ends else pauses
    span = begun_in_speech(MovementPhases(0.9, 0.95, 1.0, 1.1), 0.0, known)
    found = between_pauses(span, known)
    for start, end in ((found.start, found.apex), (found.release, found.end)):
        met = [p for p in known if p.start < end - 1e-6 and start < p.end - 1e-6]
        hurried = end - start <= 0.4 * 0.1 + 1e-6
        assert not met or hurried


def test_what_must_end_in_time_falls_before_or_after_a_pause() -> None:
    assert between_pauses(SWING, (comma(1.6, 1.7),), latest=2.0) == MovementPhases(1.0, 1.3, 1.7, 2.0)
    assert between_pauses(SWING, (comma(1.7, 1.95),), latest=2.0).end == pytest.approx(1.7)


PAUSES = st.lists(st.floats(0.5, 4.0), min_size=2, max_size=8, unique=True).map(
    lambda times: [comma(a, b) for a, b in list(pairwise(sorted(times)))[::2]]
)


@given(PAUSES, st.booleans())
def test_order_is_kept_and_no_movement_is_hurried_beyond_measure(pauses: list[StillTime], ends: bool) -> None:
    known = [*pauses, stop(4.2)] if ends else pauses
    found = between_pauses(SWING, known)
    assert found.start <= found.apex <= found.release <= found.end
    least = synchrony().least_time
    assert found.apex - found.start >= least * (SWING.apex - SWING.start) - 1e-9
    assert found.end - found.release >= least * (SWING.end - SWING.release) - 1e-9


@given(PAUSES)
def test_no_rise_begins_in_a_pause(pauses: list[StillTime]) -> None:
    found = begun_in_speech(SWING, 0.3, pauses)
    assert not any(p.start <= found.start < p.end for p in pauses)
    assert found.end - found.start == pytest.approx(SWING.end - SWING.start)


def test_the_head_follows_the_eyes_after_short_pauses_only() -> None:
    assert after_pauses(1.0, 0.2, (comma(1.1, 1.4),)) == 1.4
    assert after_pauses(1.0, 0.2, (comma(1.1, 1.4), comma(1.5, 1.6))) == 1.6
    assert after_pauses(1.0, 0.2, (comma(1.1, 2.4),)) == 1.0
    assert next_pause(1.0, (comma(0.5, 0.8), comma(1.25, 2.4), stop(3.0))) == pytest.approx((0.25, 1.15, 0.6))
    assert next_pause(2.5, (comma(1.25, 2.4), stop(3.0))) == (0.5, 6.0, 0.0)


@pytest.mark.parametrize(("room", "times"), [(9.0, 2), (0.6, 2), (0.4, 1), (0.31, 1)])
@pytest.mark.parametrize("then", [0.3, 0.0])
def test_a_gesture_is_made_fewer_times_where_there_is_little_time(
    room: float, times: int, then: float
) -> None:
    nod = markup_table().head["nod"]
    parts = timed_parts(nod, 2, room, 0.2, then)
    usual = gesture_seconds(nod, gesture_parts(nod, times))
    assert [p.scale for p in parts] == [p.scale for p in gesture_parts(nod, times)]
    assert parts[-1].end == pytest.approx(min(usual, room))


@pytest.mark.parametrize("name", ["nod", "shake", "beat"])
@pytest.mark.parametrize(("room", "then"), [(0.12, 0.9), (0.2, 0.9), (0.16, 0.25), (0.22, 0.25)])
def test_a_gesture_without_time_is_held_through_the_pause(name: str, room: float, then: float) -> None:
    gesture = markup_table().head[name]
    parts = timed_parts(gesture, 1, room, 0.4, then)
    for part in parts:
        for start, end in ((part.start, part.start + part.onset), (part.end - part.offset, part.end)):
            assert end <= room + 1e-9 or start >= room + 0.4 - 1e-9
    again = [p.start + p.onset for p in parts if p.start > room]
    assert all(b > a for a, b in pairwise(again))
    assert parts[-1].end <= room + 0.4 + then + 1e-9
    assert sum(p.end - p.offset >= room + 0.4 - 1e-9 and p.start < room for p in parts) == 1


def test_the_last_gesture_of_all_goes_on_when_all_is_said() -> None:
    nod = markup_table().head["nod"]
    assert timed_parts(nod, 1, 0.1)[-1].end == pytest.approx(0.6 * 0.51)


def test_a_short_movement_is_lengthened_to_a_boundary_within_reach() -> None:
    twitch = MovementPhases(1.0, 1.05, 1.07, 1.13)
    assert lasting(twitch, 0.1, ()) == twitch
    assert lasting(twitch, 0.25, ()).apex == pytest.approx(1.1)
    assert lasting(twitch, 0.25, (1.2, 1.3)).end == 1.3
    assert lasting(twitch, 0.25, (1.2, 1.6)).end == 1.25
