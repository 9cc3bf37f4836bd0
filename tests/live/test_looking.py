"""Looks that a live face is told: eyes first, then the head, and back."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from risorius import Live, Settings
from risorius.core.parameters import INDEX, NAMES
from risorius.errors import InputError, ParameterError
from risorius.live.looking import Looking, direction_of

EYES, HEAD = [INDEX["gaze_pitch"], INDEX["gaze_yaw"]], [INDEX["head_pitch"], INDEX["head_yaw"]]
FPS = Fraction(100)


@pytest.mark.parametrize("target", ["lft", "", (1.0,), (1.0, 2.0, 3.0), ("a", "b"), 3.0])
def test_what_is_no_direction_is_refused(target: object) -> None:
    with pytest.raises(InputError):
        direction_of(target)  # type: ignore[arg-type]


@pytest.mark.parametrize("target", [(41.0, 0.0), (0.0, -61.0), (float("nan"), 0.0)])
def test_angles_out_of_range_are_refused(target: tuple[float, float]) -> None:
    with pytest.raises(ParameterError, match="out of range"):
        direction_of(target)


def shown(looking: Looking, first: int, count: int, head: float = 0.0) -> np.ndarray:
    values = np.zeros(len(NAMES))
    values[HEAD[1]], values[EYES[1]] = head, -head
    return np.array([looking.shown(values, index) for index in range(first, first + count)])


@pytest.mark.parametrize("target", [(0.0, 8.0), (0.0, 40.0), (-16.0, -30.0)])
def test_the_eyes_land_first_and_gaze_stays_while_the_head_follows(target: tuple[float, float]) -> None:
    looking = Looking(FPS)
    looking.look(target)
    frames = shown(looking, 0, 200)
    gaze = frames[:, EYES] + frames[:, HEAD]
    landed = round(100 * (0.025 + 0.0024 * np.hypot(*target))) + 1
    assert gaze[landed:] == pytest.approx(np.tile(target, (200 - landed, 1)))
    moved = np.abs(frames[:, HEAD]).max(axis=1)
    assert moved[: landed - 1].max() < 1e-3
    assert (moved[-1] > 5) == (np.hypot(*target) > 20)


def test_gaze_holds_while_the_head_nods() -> None:
    looking = Looking(FPS)
    looking.look((0.0, 20.0))
    shown(looking, 0, 100)
    frames = shown(looking, 100, 1, head=7.0)
    assert (frames[:, EYES] + frames[:, HEAD])[0] == pytest.approx([0.0, 20.0])


def test_given_back_the_looks_are_the_face_s_own() -> None:
    looking = Looking(FPS)
    looking.look((0.0, 40.0))
    shown(looking, 0, 100)
    looking.look(None)
    frames = shown(looking, 100, 200)
    assert frames[-1] == pytest.approx(np.zeros(len(NAMES)))
    speed = np.abs(np.diff(frames[:, HEAD[1]])).max() * 100
    assert 20 < speed < 200


def test_one_look_after_another_jumps_nowhere() -> None:
    looking = Looking(FPS)
    looking.look((0.0, 30.0))
    first = shown(looking, 0, 12)
    looking.look((10.0, -30.0))
    second = shown(looking, 12, 100)
    frames = np.concatenate([first, second])
    assert np.abs(np.diff(frames[:, HEAD], axis=0)).max() < 3
    assert (second[-1, EYES] + second[-1, HEAD]) == pytest.approx([10.0, -30.0])


def test_a_live_face_looks_until_told_otherwise() -> None:
    face = Live(Settings(lively=False), fps=30)
    frames = face.frames()
    assert next(frames).values[EYES + HEAD] == pytest.approx(np.zeros(4))
    face.look("left")
    looks = [next(frames).values for _ in range(60)]
    assert looks[30][EYES[1]] + looks[30][HEAD[1]] == pytest.approx(20.0)
    face.look(None)
    assert [next(frames).values for _ in range(60)][-1][EYES + HEAD] == pytest.approx(np.zeros(4))
