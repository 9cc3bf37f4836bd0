"""VRM's presets: vowels from the mouth, emotions from the emotion channel, and no sum above 1."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from risorius.core.action_units import in_parameters
from risorius.core.arkit import INDEX
from risorius.core.parameters import INDEX as PARAMETER
from risorius.core.parameters import NEUTRAL, parameters_named
from risorius.errors import RisoriusError
from risorius.face.fit.expressions import (
    VOWELS,
    Expression,
    emotion_presets,
    emotion_weights,
    expressions,
    preset_weights,
)
from risorius.rules.emotions import emotion


def presets_of(shapes: Mapping[str, float], seal: float = 0.0) -> dict[str, float]:
    weights = np.zeros((1, 52))
    for name, value in shapes.items():
        weights[0, INDEX[name]] = value
    found = preset_weights(weights, np.array([seal]))
    return dict(zip(expressions(), found[0].tolist(), strict=True))


def felt(muscles: Mapping[str, float]) -> dict[str, float]:
    values = np.array(NEUTRAL)
    for name, value in muscles.items():
        for parameter in parameters_named(name):
            values[PARAMETER[parameter.name]] = value
    return dict(zip(emotion_presets(), emotion_weights(values[None])[0].tolist(), strict=True))


@pytest.mark.parametrize(
    "wrong",
    [
        {},
        {"shapes": {"jawOpen": 1.0}, "muscles": {"masseter": 1.0}},
        {"shapes": {"jawShut": 1.0}},
        {"muscles": {"jawOpen": 1.0}},
    ],
)
def test_wrong_rows(wrong: dict[str, dict[str, float]]) -> None:
    with pytest.raises(RisoriusError):
        Expression("X", **wrong)


def test_speech_and_a_smile_of_the_face_make_nothing_happy() -> None:
    found = presets_of({"mouthSmileLeft": 1.0, "mouthSmileRight": 1.0, "browInnerUp": 1.0, "jawOpen": 0.2})
    assert [found[name] for name in emotion_presets()] == [0.0] * len(emotion_presets())
    assert found["aa"] == pytest.approx(0.36)


def test_no_vowel_shows_while_the_lips_are_sealed() -> None:
    shapes = {"jawOpen": 0.2, "mouthFunnel": 0.1, "mouthPucker": 0.1, "mouthStretchLeft": 0.3}
    assert max(presets_of(shapes)[name] for name in VOWELS) > 0.1
    assert [presets_of(shapes, 1.0)[name] for name in VOWELS] == [0.0] * 5
    half = presets_of(shapes, 0.5)
    assert half["oh"] == pytest.approx(0.5 * presets_of(shapes)["oh"])


def test_vowels_together_are_at_most_one() -> None:
    found = presets_of({"jawOpen": 1.0, "mouthStretchLeft": 1.0, "mouthStretchRight": 1.0})
    assert sum(found[name] for name in VOWELS) == pytest.approx(1.0)
    assert found["aa"] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("name", "preset"),
    [("happiness", "happy"), ("anger", "angry"), ("sadness", "sad"), ("surprise", "surprised")],
)
def test_an_emotion_moves_its_own_preset(name: str, preset: str) -> None:
    muscles = in_parameters(emotion(name).units)
    found = felt({name: value for name, value in muscles.items() if value > 0.0})
    assert found[preset] > 0.7
    assert max(value for other, value in found.items() if other != preset) < 0.1


def test_emotions_together_are_at_most_one() -> None:
    found = felt({"zygomatic_major": 1.0, "frontalis_lateralis": 1.0, "depressor_supercilii": 1.0})
    assert sum(found.values()) == pytest.approx(1.0)
