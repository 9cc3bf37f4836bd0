"""Emotions alone: what else moves the face does not count."""

from __future__ import annotations

import numpy as np

from risorius.blend import emotion_curves
from risorius.core.movement import ManualCurve, Movement
from risorius.core.parameters import INDEX, NEUTRAL
from risorius.core.score import Score

TIMES = np.linspace(0.0, 2.0, 41)
SMILE = "zygomatic_major.left"


def smile(channel: str, value: float, layer: str = "") -> Movement:
    return Movement(channel, 0.2, 1.8, 0.3, 0.3, {SMILE: value}, layer=layer)


def test_other_channels_and_drawn_curves_do_not_count() -> None:
    others = (smile("signals", 0.9), smile("emotion", 0.7, "posture"))
    drawn = (ManualCurve({SMILE: ((0.0, 1.0), (2.0, 1.0))}),)
    assert np.array_equal(emotion_curves(Score(2.0, others, manual=drawn), TIMES), np.tile(NEUTRAL, (41, 1)))


def test_an_emotion_is_as_it_would_be_alone() -> None:
    curve = emotion_curves(Score(2.0, (smile("signals", 0.9), smile("emotion", 0.5))), TIMES)
    assert curve[:, INDEX[SMILE]].max() == 0.5
    assert curve[[0, -1], INDEX[SMILE]].tolist() == [0.0, 0.0]
    alone = emotion_curves(Score(2.0, (smile("emotion", 0.5),)), TIMES)
    assert np.array_equal(curve, alone)
    assert np.array_equal(
        np.delete(curve, INDEX[SMILE], axis=1), np.tile(np.delete(NEUTRAL, INDEX[SMILE]), (41, 1))
    )
