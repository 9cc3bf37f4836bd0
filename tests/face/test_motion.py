"""The face in time: the same at every frame rate, in every order, and on time where it must close."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from risorius import blend
from risorius.core.movement import Movement
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.core.performance import Performance
from risorius.core.score import Score
from risorius.errors import ParameterError
from risorius.face.fit.measure import Gauge
from risorius.face.motion import animate, between_frames
from risorius.face.solve import FaceSolver

from .conftest import values_of

RATES = (25, 30, 60, 120)
DURATION = 1.2


def moving(start, end, targets, **timing):
    return Movement("emotion", start, end, targets=targets, onset=0.12, offset=0.15, **timing)


@pytest.fixture(scope="module")
def plan():
    bases = ("zygomatic_major", "frontalis_medialis")
    smile = {f"{base}.{side}": 1.0 for base in bases for side in ("left", "right")}
    movements = (moving(0.1, 0.7, smile), moving(0.4, 0.9, {"masseter": 0.4}))
    return blend.Plan(Score(DURATION, movements=movements))


def performance(plan, fps):
    return blend.combine(plan.score, Fraction(fps))


def held(*rows, fps=30):
    return Performance(Score(len(rows) / fps), Fraction(fps), np.stack(rows))


def skins(frames):
    return np.stack([frame.skin for frame in frames])


@pytest.mark.parametrize("bad", [np.nan, 1.2, -0.5])
@pytest.mark.parametrize("dynamics", [True, False])
def test_a_bad_value_is_named(solver, bad, dynamics):
    row = np.array(NEUTRAL)
    row[INDEX["mentalis.left"]] = bad
    with pytest.raises(ParameterError, match=r"mentalis\.left = .* expected 0 to 1"):
        list(animate(held(NEUTRAL, row), solver, dynamics))


def test_a_held_face_is_the_static_one(solver):
    values = values_of({"AU12": 0.8, "AU2": 0.5, "masseter": 0.3, "AU45": 0.4})
    frames = skins(animate(held(*[values] * 4), solver))
    np.testing.assert_allclose(frames, np.broadcast_to(solver.solve(values).skin, frames.shape), atol=1e-4)


def test_without_dynamics_each_frame_is_the_static_one(solver, plan):
    played = performance(plan, 30)
    for i, frame in zip((3, 20), animate(played, solver, False, indices=(3, 20)), strict=True):
        assert frame.skin.tobytes() == solver.solve(played.values[i]).skin.tobytes()


def test_every_frame_rate_shows_the_same_face_at_the_same_time(solver, plan):
    faces = {fps: skins(animate(performance(plan, fps), solver, drive=plan.at)) for fps in RATES}
    for fps in RATES[1:]:
        common = np.gcd(fps, RATES[0])
        one, other = faces[RATES[0]][:: RATES[0] // common], faces[fps][:: fps // common]
        assert np.abs(one - other).max() <= 0.1, fps


def test_the_skin_lags_and_swings_over(solver, plan, head):
    played = performance(plan, 120)
    rest = head.skin.matrix @ head.rest
    frames = skins(animate(played, solver, drive=plan.at)) - rest
    static = skins(animate(played, solver, False)) - rest
    cheek = np.argmin(np.linalg.norm(rest - [40.0, -45.0, 5.0], axis=1))
    moved, wanted = np.linalg.norm(frames[:, cheek], axis=1), np.linalg.norm(static[:, cheek], axis=1)
    rising = slice(18, 26)
    assert (moved[rising] < wanted[rising]).all()
    assert 1.005 * wanted.max() < moved.max() < 1.1 * wanted.max()


def test_closures_are_not_late(solver, head):
    rows = [values_of({"AU12": 1.0, "masseter": 0.2, "lip_seal": float(k >= 5)}) for k in range(10)]
    gauge = Gauge(head)
    gaps = [gauge.measure(frame).lip_gap_mm for frame in animate(held(*rows), solver)]
    assert min(gaps[:5]) > 0.5
    assert max(gaps[5:]) <= 0.05


def test_lids_close_on_time(solver, head):
    rows = [values_of({"AU45": float(k >= 2), "AU6": float(k >= 2)}) for k in range(4)]
    gauge = Gauge(head)
    gaps = [gauge.measure(frame).eye_gap_left_mm for frame in animate(held(*rows), solver)]
    assert gaps[1] > 5.0
    assert gaps[2] == pytest.approx(0.0, abs=0.01)


def test_some_frames_are_as_in_the_whole(solver, plan):
    played = performance(plan, 30)
    whole = list(animate(played, solver, drive=plan.at))
    for indices in ((7,), (3, 4, 20), (20, 5, 5)):
        for i, frame in zip(indices, animate(played, solver, drive=plan.at, indices=indices), strict=True):
            assert frame.skin.tobytes() == whole[i].skin.tobytes(), indices


def test_two_performances_at_once_do_not_meet(solver, plan):
    played = performance(plan, 30)
    alone = [frame.skin.tobytes() for frame in animate(played, solver)]
    other = animate(held(*[values_of({"AU9": k % 2}) for k in range(len(alone))]), solver)
    assert [frame.skin.tobytes() for frame, _ in zip(animate(played, solver), other, strict=True)] == alone


def test_a_fraction_as_frame_rate(solver, plan):
    assert len(list(animate(performance(plan, Fraction(24000, 1001)), solver, drive=plan.at))) == 30


def test_between_frames_lie_straight_lines():
    drive = between_frames(held(NEUTRAL, values_of({"masseter": 1.0}), fps=10))
    found = drive(np.array([0.0, 0.025, 0.1, 5.0]))[:, INDEX["masseter"]]
    np.testing.assert_allclose(found, [0.0, 0.25, 1.0, 1.0])
    single = between_frames(held(values_of({"masseter": 0.4})))
    np.testing.assert_allclose(single(np.array([0.0, 1.0]))[:, INDEX["masseter"]], 0.4)


def test_the_biphasic_skin_holds_a_muscle_alone_and_yields_less_to_many(head, solver):
    stiff = FaceSolver(head, phases="biphasic")
    alone = values_of({"AU1": 1.0, "AU17": 1.0})
    np.testing.assert_allclose(stiff.solve(alone).skin, solver.solve(alone).skin, atol=0.6)
    many = values_of({"AU12": 1.0, "AU6": 1.0, "AU20": 1.0})
    assert np.abs(stiff.solve(many).skin - solver.solve(many).skin).max() > 0.1
    played = skins(animate(held(many, many), stiff))
    np.testing.assert_allclose(played[1], stiff.solve(many).skin, atol=0.02)


def test_a_second_before_a_frame_is_all_that_its_skin_remembers(solver):
    rows = [np.array(NEUTRAL) for _ in range(60)]
    for k, row in enumerate(rows):
        row[INDEX["zygomatic_major.left"]] = 0.5 + 0.5 * np.sin(k)
    whole = skins(animate(held(*rows), solver, indices=range(45, 50)))
    near = skins(animate(held(*rows), solver, indices=range(45, 50), lead_in=1.0))
    late = skins(animate(held(*rows), solver, indices=range(45, 50), lead_in=0.05))
    assert np.abs(whole - near).max() < 1e-5
    assert np.abs(whole - late).max() > 1e-2


def test_before_the_start_there_is_no_lead_in(solver, plan):
    frames = performance(plan, 30)
    assert np.array_equal(skins(animate(frames, solver)), skins(animate(frames, solver, lead_in=5.0)))
