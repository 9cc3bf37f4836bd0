import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.rules.synchrony import MovementPhases, ended_in_pause, synchrony

SWING = MovementPhases(1.0, 1.3, 1.5, 2.0)


def test_a_movement_far_from_a_pause_stays_as_it_is():
    assert ended_in_pause(SWING, ()) == SWING
    assert ended_in_pause(SWING, (0.2, 5.0)) == SWING


def test_a_movement_that_runs_into_a_pause_has_ended_soon_after_its_start():
    found = ended_in_pause(SWING, (1.7,))
    assert found.end == pytest.approx(1.7 + synchrony().settling)
    assert (found.apex - 1.0) / (found.end - 1.0) == pytest.approx(0.3)


@given(st.lists(st.floats(0.0, 3.0), max_size=4))
def test_order_is_kept_and_no_movement_is_hurried_beyond_measure(pauses):
    found = ended_in_pause(SWING, sorted(pauses))
    assert found.start == SWING.start <= found.apex <= found.release <= found.end <= SWING.end
    assert found.end - found.start >= synchrony().least_time * (SWING.end - SWING.start) - 1e-9
