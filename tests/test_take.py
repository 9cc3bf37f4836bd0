"""A take can go to another process, and is the same there; its head is one head, its shape included."""

from __future__ import annotations

import gc
import pickle
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import risorius
from risorius.core.parameters import INDEX
from risorius.settings import Settings
from risorius.solvers import make_solver

SHAPE = {"jaw_width": 1.0, "cheekbones": 1.0, "nose_width": 1.0}


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


def test_curves_between_frames_are_exact_in_all_that_moves_the_skin() -> None:
    take = risorius.speak("Five, yes.", emotion={"joy": 0.5})
    times = np.arange(0, 150) / 120
    assert take.planned is not None
    exact, between = take.planned.at(times), take._curves_between_frames(times)
    for name in take.head.fields:
        np.testing.assert_array_equal(between[:, INDEX[name]], exact[:, INDEX[name]])
    assert exact[:, INDEX["lip_tuck"]].any()
    assert not between[:, INDEX["head_pitch"]].any()


def test_a_pickled_take_has_its_words_and_its_sound_when_the_first_is_gone() -> None:
    take = _spoken()
    assert take.utterance is not None
    words, sound, pickled = take.utterance.words, take.utterance.audio.read(), pickle.dumps(take)
    del take
    gc.collect()
    again = pickle.loads(pickled)
    assert again.utterance.words == words
    np.testing.assert_array_equal(again.utterance.audio.read(), sound)


@pytest.fixture(scope="module")
def takes() -> tuple[risorius.Take, risorius.Take]:
    """A face at rest as it is, and one whose shape is changed."""
    plain, shaped = (risorius.pose({}, settings=Settings(shape=shape)) for shape in ({}, SHAPE))
    return plain, shaped


def test_the_shape_moves_the_face_that_performs(takes: tuple[risorius.Take, risorius.Take]) -> None:
    plain, shaped = (next(take.faces()).skin for take in takes)
    assert np.abs(shaped - plain).max() > 2.0


def test_the_shape_leaves_the_arkit_weights_of_a_face_at_rest(
    takes: tuple[risorius.Take, risorius.Take],
) -> None:
    plain, shaped = (take.arkit for take in takes)
    np.testing.assert_allclose(shaped.weights, plain.weights, atol=0.01)
    assert shaped.residual[1] < 0.1


@pytest.mark.parametrize("changed", [{"age": 70.0}, {"shape": SHAPE}])
def test_the_solver_moves_the_head_that_the_take_names(changed: dict[str, object]) -> None:
    settings = Settings(**changed)  # type: ignore[arg-type]
    assert make_solver(settings).head is risorius.pose({}, settings=settings).head


def test_a_notebook_shows_the_middle_frame(clip: risorius.Take) -> None:
    shown = Image.open(BytesIO(clip._repr_png_()))
    assert (shown.format, shown.size, shown.mode) == ("PNG", (320, 320), "RGB")
    assert np.asarray(shown).std() > 10.0
