"""A clip is longer than its sound, and holds its last pose: players loop what is shorter."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from risorius.api import speak
from risorius.core.speech.audio import Audio
from risorius.ports.mesh.gltf import clip_times, held
from risorius.settings import Settings

from ..conftest import TakeMaker
from ..gltf_reader import Document


@pytest.mark.parametrize(
    ("samples", "rate", "last"),
    [
        (22_050, 22_050, 1.04),  # ends at the last frame: a player would begin again there
        (22_049, 22_050, 1.0),
        (22_051, 22_050, 1.04),
        (40_000, 22_050, 1.84),
        (16_640, 16_000, 1.08),
    ],
)
def test_one_key_after_the_sound(
    take_of: TakeMaker, sound_of: Callable[..., Audio], samples: int, rate: int, last: float
) -> None:
    take = take_of(fps=Fraction(25), audio=sound_of(np.zeros(samples, np.int16), rate))
    times = clip_times(take)
    assert times[-1] == pytest.approx(last)
    assert np.float32(times[-1]) > samples / rate
    assert np.array_equal(times[:26], take.performance.times)
    assert len(times) <= 27


def test_a_silent_clip_is_as_long_as_its_frames(take_of: TakeMaker) -> None:
    take = take_of()
    assert np.array_equal(clip_times(take), take.performance.times)


def test_the_last_value_is_held() -> None:
    assert held(np.arange(6.0).reshape(3, 2), 5)[2:].tolist() == [[4.0, 5.0]] * 3


def test_files_hold_the_last_pose_until_the_sound_ends(tmp_path: Path) -> None:
    settings = Settings(fps=Fraction(12), dynamics="static", lead=0.1, tail=0.13)
    take = speak("Oh no!", emotion={"surprise": 0.8}, settings=settings)
    assert take.audio is not None
    assert take.times[-1] < take.audio.duration
    for name, node, path in (
        ("x.glb", "head", "rotation"),
        ("x.rig.glb", "skin", "weights"),
        ("x.vrma", "blinkLeft", "translation"),
    ):
        take.write(tmp_path / name)
        document = Document(tmp_path / name)
        clock = document.json["animations"][0]["samplers"][0]["input"]
        assert document.array(clock)[-1, 0] > take.audio.duration
        values = document.output(node, path)
        assert len(values) == len(take.times) + 1
        assert np.array_equal(values[-1], values[-2])
