"""A speaker too moved to speak: an emotion of full intensity wins over the lips (paper A, section 1)."""

from __future__ import annotations

import numpy as np
import pytest

from risorius import Settings, Take, speak
from risorius.core.arrays import Array

TEXT = "You knew that we would choose the blue moon too."
SMILE, ROUND = "zygomatic_major.left", "orbicularis_oris_funneler"


def said(felt: str, *, overwhelmed: bool, text: str = TEXT) -> Take:
    return speak(text, text=True, emotion=felt, settings=Settings(overwhelmed=overwhelmed))


def spoken(take: Take, name: str) -> Array:
    assert take.utterance is not None
    first, last = take.utterance.words[1].start, take.utterance.words[-1].end - 0.1
    return take.curves[name][(take.times >= first) & (take.times < last)]


@pytest.mark.parametrize("text", [TEXT, "Who chose those two shoes for you?"])
def test_a_smile_of_full_intensity_leaves_the_lips_no_rounding(text: str) -> None:
    usual, moved = (said("happiness:1@0", overwhelmed=o, text=text) for o in (False, True))
    throughout = said("happiness:1", overwhelmed=True, text=text)
    assert spoken(usual, ROUND).max() > 0.3
    assert spoken(usual, SMILE).min() < 0.5
    assert spoken(throughout, ROUND).max() < 0.05
    assert spoken(throughout, SMILE).min() > 0.95
    assert moved.duration == usual.duration


def test_a_weaker_one_does_not_overwhelm() -> None:
    usual, moved = (said("happiness:0.7", overwhelmed=o) for o in (False, True))
    assert all(np.array_equal(usual.curves[n], moved.curves[n]) for n in (SMILE, ROUND))


@pytest.mark.parametrize("felt", ["anger", "sadness", "surprise", "pride"])
def test_every_emotion_may_overwhelm(felt: str) -> None:
    take = said(f"{felt}:1", overwhelmed=True)
    priorities = {m.priority for m in take.score.movements if m.cause.rule == "emotion.display"}
    assert priorities
    assert all(p is not None and p > 60.0 for p in priorities)


def test_a_priority_of_ones_own_is_kept() -> None:
    take = said("happiness:1/33", overwhelmed=True)
    assert {m.priority for m in take.score.movements if m.cause.rule == "emotion.display"} == {33.0}
