"""A take can go to another process, and is the same there."""

from __future__ import annotations

import gc
import pickle

import numpy as np
import pytest

import risorius
from risorius.settings import Settings


def _spoken() -> risorius.Take:
    return risorius.speak("Hi, mum!", emotion={"anger": 0.5}, settings=Settings(dynamics="static"))


def _posed() -> risorius.Take:
    return risorius.pose({"AU12": 0.8, "jaw_open": 0.3}, emotion={"fear": 0.5})


@pytest.mark.parametrize("make", [_spoken, _posed])
def test_a_pickled_take_has_equal_curves_explanations_and_faces(make) -> None:  # type: ignore[no-untyped-def]
    take = make()
    middle = len(take.times) // 2
    face = next(take.faces([middle]))  # what was made on demand must not stand in the way
    again = pickle.loads(pickle.dumps(take))
    assert (again.score, again.settings) == (take.score, take.settings)
    np.testing.assert_array_equal(again.performance.values, take.performance.values)
    assert again.explain(take.times[middle]) == take.explain(take.times[middle])
    np.testing.assert_array_equal(next(again.faces([middle])).skin, face.skin)


def test_a_pickled_take_has_its_words_and_its_sound_when_the_first_is_gone() -> None:
    take = _spoken()
    assert take.utterance is not None
    words, sound, pickled = take.utterance.words, take.utterance.audio.read(), pickle.dumps(take)
    del take
    gc.collect()
    again = pickle.loads(pickled)
    assert again.utterance.words == words
    np.testing.assert_array_equal(again.utterance.audio.read(), sound)
