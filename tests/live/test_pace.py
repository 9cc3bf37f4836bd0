"""Pace: by a clock that the test sets."""

from __future__ import annotations

from fractions import Fraction

from risorius.live.pace import Pace


def test_frames_are_due_by_the_rate_from_the_first_on_and_the_late_catch_up() -> None:
    time = 100.0
    pace = Pace(Fraction(10), lambda: time)
    assert pace.wait(7) == 0
    assert abs(pace.wait(8) - 0.1) < 1e-9
    time = 101.0
    assert pace.wait(9) == 0
    assert pace.wait(16) == 0
    assert abs(pace.wait(18) - 0.1) < 1e-9
