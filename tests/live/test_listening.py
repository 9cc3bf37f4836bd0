"""Listening: nods at pauses, however the sound is cut; refusals."""

from __future__ import annotations

from itertools import islice

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from risorius import Live, speak
from risorius.core.arrays import Array
from risorius.errors import InputError
from risorius.live.listening import NOD_DEGREES, PauseListener, nod_pitch
from risorius.live.low_pitch import pitch_of
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


def voice(*parts: tuple[float, float], loudness: float = 0.1) -> Array:
    """Return a voice of harmonics, at (seconds, Hz) one after another."""
    hertz = np.concatenate([np.full(round(seconds * RATE), pitch) for seconds, pitch in parts])
    phase = 2 * np.pi * np.cumsum(hertz) / RATE
    sound: Array = loudness * sum(np.sin(k * phase) / k for k in range(1, 8))
    return sound


def moments(sound: Array) -> list[float]:
    """Return the seconds at which a listener nods."""
    listener = PauseListener()
    return [end / RATE for end in range(320, len(sound), 320) if listener.hear(sound[end - 320 : end], RATE)]


def test_low_pitch_is_answered_seven_tenths_of_a_second_later() -> None:
    assert moments(voice((3.0, 200.0), (0.2, 140.0), (3.0, 210.0))) == pytest.approx(
        [3.0 + 0.11 + 0.7], abs=0.06
    )


@pytest.mark.parametrize(
    ("what", "sound"),
    [
        ("too short", voice((3.0, 200.0), (0.08, 140.0), (3.0, 210.0))),
        ("high", voice((3.0, 200.0), (0.3, 280.0), (3.0, 200.0))),
        ("all alike", voice((6.0, 180.0))),
        ("noise", 0.1 * np.random.default_rng(1).normal(size=6 * RATE).clip(-1, 1)),
    ],
)
def test_other_pitch_is_not_answered(what: str, sound: Array) -> None:
    assert moments(sound) == [], what


@pytest.mark.parametrize("rate", [8_000, 16_000, 22_050, 44_100, 48_000])
@pytest.mark.parametrize("hertz", [80.0, 120.0, 220.0, 400.0])
def test_the_pitch_of_a_voice_is_found(rate: int, hertz: float) -> None:
    step = max(1, rate // 8_000)
    times = np.arange(round(0.04 * rate)) / rate
    sound = sum(np.sin(2 * np.pi * k * hertz * times) / k for k in range(1, 6))
    thin = sound[: len(sound) // step * step].reshape(-1, step).mean(axis=1)
    assert pitch_of(thin, rate / step) == pytest.approx(hertz, rel=0.03)


def test_a_voice_that_says_sentences_is_answered_where_they_end() -> None:
    """Pitch falls at the end of what is said; pauses are answered at once."""
    text = "I went to the market this morning. They had no bread at all, so I came home."
    utterance = speak(text, text=True).utterance
    assert utterance is not None
    audio = utterance.audio
    listener, nodded = PauseListener(), []
    for number, block in enumerate(audio.blocks(audio.sample_rate // 50)):
        if listener.hear(block, audio.sample_rate):
            nodded.append(number / 50)
    ends = [phrase.end for phrase in utterance.phrases]
    assert nodded
    assert all(any(0.0 <= nod - end <= 0.9 for end in ends) for nod in nodded), (nodded, ends)


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
