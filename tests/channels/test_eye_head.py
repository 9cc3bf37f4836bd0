from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from risorius.blend import at, combine
from risorius.channels.eye_head import GazeShift, head_duration, head_help, head_share, shifts_of
from risorius.core.counter_rng import CounterRng
from risorius.core.movement import Cause, Movement
from risorius.core.parameters import INDEX
from risorius.core.score import Score
from risorius.rules.profiles import profile
from risorius.rules.saccade import saccade_duration

ANGLES = st.floats(-40.0, 40.0)
UNBLINKING = replace(profile("neutral").blinks, shift=0.0)


def performed(*shifts: tuple[float, tuple[float, float]], duration: float = 6.0) -> dict[str, np.ndarray]:
    """Return the curves of shifts of gaze at 1000 frames a second."""
    cause = Cause("test")
    found = tuple(
        shifts_of([GazeShift(t, d, cause) for t, d in shifts], duration, UNBLINKING, (), (), CounterRng(0))
    )
    assert all(isinstance(m, Movement) for m in found)
    return combine(Score(duration, found), Fraction(1000)).curves


@given(ANGLES)
def test_small_shifts_are_the_eyes_alone(shift: float) -> None:
    share = head_share(shift, 0.0)
    assert share == 0.0 if abs(shift) < 10.0 else 0.0 <= share / shift < 0.72


@given(ANGLES, st.floats(-20.0, 20.0), st.floats(0.0, 0.01))
def test_the_head_s_share_is_continuous_and_grows_with_the_shift(
    shift: float, eye: float, step: float
) -> None:
    if shift < 0.0 <= shift + step:
        return
    change = head_share(shift + step, eye) - head_share(shift, eye)
    assert -1e-12 <= change <= step + 1e-12


def test_an_eye_already_turned_leaves_more_to_the_head() -> None:
    assert head_share(20.0, 15.0) > head_share(20.0, 0.0) > head_share(20.0, -15.0)


@pytest.mark.parametrize(("degrees", "seconds"), [(10.0, 0.364), (20.0, 0.426), (40.0, 0.465)])
def test_how_long_the_head_takes(degrees: float, seconds: float) -> None:
    assert head_duration(degrees) == pytest.approx(seconds, abs=0.001)


@pytest.mark.parametrize("goal", [(0.0, 8.0), (0.0, 25.0), (10.0, -22.0), (-14.0, 5.0)])
def test_gaze_lands_with_the_eyes_and_stays_while_the_head_follows(goal: tuple[float, float]) -> None:
    curves = performed((1.0, goal))
    landed = round(1000 * (1.0 + saccade_duration(float(np.hypot(*goal))))) + 1
    for axis, wanted in zip(("pitch", "yaw"), goal, strict=True):
        world = curves[f"gaze_{axis}"] + curves[f"head_{axis}"]
        assert np.abs(world[landed : landed + 1500] - wanted).max() < 1e-6
        assert np.abs(world[:1000]).max() < 1e-9


def test_eyes_lead_and_the_head_moves_later() -> None:
    curves = performed((1.0, (0.0, 25.0)))
    eyes, head = (int(np.argmax(np.abs(curves[n]) > 0.2)) for n in ("gaze_yaw", "head_yaw"))
    assert 0.02 < (head - eyes) / 1000 < 0.15


def test_back_to_the_listener_brings_the_head_to_rest() -> None:
    curves = performed((1.0, (0.0, 25.0)), (2.5, (0.0, 0.0)))
    assert abs(curves["head_yaw"][2400]) > 5.0
    for name in ("head_yaw", "gaze_yaw"):
        assert np.abs(curves[name][3500:]).max() < 1e-6


@given(st.lists(st.tuples(st.floats(0.0, 5.0), st.tuples(ANGLES, ANGLES)), max_size=8))
def test_any_shifts_make_a_score_without_jumps(shifts: list[tuple[float, tuple[float, float]]]) -> None:
    curves = performed(*sorted(shifts))
    for name in ("gaze_pitch", "gaze_yaw", "head_pitch", "head_yaw"):
        # 600 degrees a second at most.
        assert np.abs(np.diff(curves[name])).max() < 1.6


@pytest.mark.parametrize("degrees", [1.0, 2.0, 5.0, 8.0, 9.9, 12.0, 15.0, 20.0])
def test_saccades_follow_the_main_sequence_on_the_curves(degrees: float) -> None:
    """Peak speed 473(1 - e^(-A/7.8)) degrees a second, 25 ms + 2.4 ms a degree: science/03."""
    cause = Cause("test")
    shifts = tuple(shifts_of([GazeShift(0.5, (0.0, degrees), cause)], 1.5, UNBLINKING, (), (), CounterRng(0)))
    times = np.arange(0.4, 0.8, 1e-4)
    columns = at(Score(1.5, shifts), times)
    world = columns[:, INDEX["gaze_yaw"]] + columns[:, INDEX["head_yaw"]]
    speed = np.gradient(world, times)
    moving = np.flatnonzero(speed > 1.0)
    assert (moving[-1] - moving[0]) * 1e-4 == pytest.approx(0.025 + 0.0024 * degrees, rel=0.1)
    assert speed.max() == pytest.approx(473.0 * (1.0 - np.exp(-degrees / 7.8)), rel=0.1)
    assert 1.5 <= speed.max() / speed[moving].mean() <= 1.7


def test_saccades_are_at_least_50_ms_apart() -> None:
    close = [(0.5 + 0.01 * k, (0.0, 8.0 * (k % 2))) for k in range(60)]
    cause = Cause("test")
    found = shifts_of([GazeShift(t, d, cause) for t, d in close], 2.0, UNBLINKING, (), (), CounterRng(0))
    eyes = sorted((m.start, m.start + m.onset) for m in found if m.function == "saccade")
    assert len(eyes) > 5
    assert min(b[0] - a[1] for a, b in pairwise(eyes)) >= 0.05 - 1e-9


def test_large_shifts_blink_and_small_ones_hardly_ever() -> None:
    def share(degrees: float) -> float:
        shifts = [GazeShift(2.0 * k, (0.0, degrees * (k % 2)), Cause("test")) for k in range(200)]
        found = shifts_of(shifts, 400.0, profile("neutral").blinks, (), (), CounterRng(1))
        return sum(m.layer == "lids" for m in found) / 199

    assert share(34.0) == pytest.approx(0.97, abs=0.04)
    assert share(3.0) < 0.03


def test_a_marked_look_is_shared_with_the_head() -> None:
    mark = Movement("gaze", 1.0, 3.0, 0.07, 0.07, {"gaze_pitch": 0.0, "gaze_yaw": 24.0}, "look")
    curves = combine(Score(5.0, (mark, *filter(None, [head_help(mark)]))), Fraction(1000)).curves
    world = curves["gaze_yaw"] + curves["head_yaw"]
    assert curves["head_yaw"][2500] == pytest.approx(head_share(24.0, 0.0))
    assert world[2500] == pytest.approx(24.0, abs=1.0)
    assert abs(world[4500]) < 1e-9
    near = Movement("gaze", 1.0, 3.0, 0.07, 0.07, {"gaze_pitch": 5.0, "gaze_yaw": 8.0}, "look")
    assert head_help(near) is None
