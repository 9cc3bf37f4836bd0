"""Listening: nods at pauses, however the sound is cut; refusals."""

from __future__ import annotations

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from risorius import Live
from risorius.core.arrays import Array
from risorius.errors import InputError
from risorius.live.listening import NOD_DEGREES, PauseListener, nod_pitch
from risorius.settings import Settings

RATE = 16_000


def tone(seconds: float, loudness: float = 0.2) -> Array:
    wave: Array = loudness * np.sin(np.arange(round(seconds * RATE)) * 0.1)
    return wave


TALK = np.concatenate([tone(1.5), np.zeros(8_000), tone(3.0), np.zeros(16_000)])


@pytest.mark.parametrize(
    ("samples", "rate", "message"),
    [
        (np.zeros(10), 0, "rate"),
        (np.zeros(10), 16_000.5, "rate"),
        (np.zeros((2, 10)), RATE, "one channel"),
        (np.zeros(10, np.int32), RATE, "one channel"),
        ("sound", RATE, "one channel"),
        (np.full(10, np.nan), RATE, "beyond"),
        (np.full(10, 300.0), RATE, "beyond"),
    ],
)
def test_what_is_no_sound_is_refused(samples: Array, rate: int, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Live().listen(samples, rate)


def nods(pieces: list[ArrayLike]) -> int:
    listener = PauseListener()
    return sum(listener.hear(piece, RATE) for piece in pieces)


@settings(max_examples=20, deadline=None)
@given(st.lists(st.integers(0, len(TALK)), max_size=8))
def test_pauses_after_speech_are_answered_however_it_is_cut(cuts: list[int]) -> None:
    pieces = np.split(TALK, sorted(cuts))
    listener, heard, moments = PauseListener(), 0, []
    for block in (b for piece in pieces for b in np.array_split(piece, max(1, len(piece) // 100))):
        heard += len(block)
        if listener.hear(block, RATE):
            moments.append(heard / RATE)
    np.testing.assert_allclose(moments, [1.7, 5.2], atol=0.03)


def test_silence_short_words_and_speech_without_end_are_not_answered() -> None:
    assert nods([np.zeros(5 * RATE)]) == 0
    assert nods([tone(0.5), np.zeros(RATE)]) == 0
    assert nods([tone(20.0)]) == 0
    assert nods([(TALK * 32_767).astype(np.int16)[: 2 * RATE]]) == 1


def test_the_head_goes_down_and_returns() -> None:
    assert min(nod_pitch(k / 60) for k in range(30)) == pytest.approx(NOD_DEGREES)
    assert nod_pitch(0.0) == nod_pitch(0.5) == nod_pitch(-0.1) == 0


def test_a_face_nods_at_a_pause_and_not_while_it_speaks() -> None:
    def pitches(said: str, heard: Array) -> Array:
        face = Live(Settings(lively=False), fps=30)
        face.say(said)
        face.flush()
        frames = face.frames()
        next(frames)
        face.listen(heard, RATE)
        return np.array([frame.parameters["head_pitch"] for frame in islice(frames, 20)])

    nod = pitches("", TALK[: 2 * RATE]) - pitches("", np.zeros(100))
    assert nod.min() == pytest.approx(NOD_DEGREES)
    assert nod[-1] == 0
    np.testing.assert_array_equal(pitches("Hello.", TALK), pitches("Hello.", np.zeros(100)))
