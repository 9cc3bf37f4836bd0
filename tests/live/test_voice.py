"""The face's own voice in pieces: cuts, words' times, text, neither; what cannot be used."""

from __future__ import annotations

from itertools import islice, pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from risorius import Live, Settings, speak
from risorius.core.arrays import Array
from risorius.core.parameters import INDEX
from risorius.core.speech.utterance import Utterance
from risorius.errors import InputError
from risorius.live.frame import LiveFrame
from risorius.live.voice import LATEST, LONGEST_WAITING, Known, VoiceBuffer

TEXT = "Well, that is a long story. She paid him for it."
JAW = INDEX["masseter"]
RATE = 16_000


@pytest.fixture(scope="module")
def spoken() -> Utterance:
    utterance = speak(TEXT, text=True).utterance
    assert utterance is not None
    return utterance


@pytest.fixture(scope="module")
def timed(spoken: Utterance) -> list[tuple[str, float, float]]:
    marked = TEXT.split()
    return [(marked[n], word.start, word.end) for n, word in enumerate(spoken.words)]


def samples_of(spoken: Utterance) -> np.ndarray:
    return spoken.audio.read()


def heard(face: Live) -> list[LiveFrame]:
    face.close()
    return list(face.frames())


def sound_of(frames: list[LiveFrame]) -> Array:
    return np.concatenate([frame.sound for frame in frames])


@pytest.mark.parametrize(
    ("call", "fault"),
    [
        ({"audio": b"ab"}, "sound without its rate"),
        ({"rate": 8_000}, "a rate or words without sound"),
        ({"words": [("a", 0, 1)]}, "a rate or words without sound"),
        ({"audio": b"", "rate": 4_000}, "sample rate 4000"),
        ({"audio": b"", "rate": 8_000, "encoding": "mp3"}, "unknown encoding 'mp3'"),
        ({"audio": [2.0], "rate": 8_000}, r"beyond -1\.\.1"),
        ({"audio": b"", "rate": 8_000, "words": [("a", 1.0)]}, r"expected \(word, start, end\)"),
        ({"audio": b"", "rate": 8_000, "words": [("a", 1.0, 0.5)]}, "expected it to end after it starts"),
        ({"audio": b"", "rate": 8_000, "words": [("a", 0.1, 0.5), ("b", 0.2, 0.6)]}, "one after another"),
        ({"audio": np.zeros(int(LONGEST_WAITING) * 8_000 + 1), "rate": 8_000, "text": "a"}, "expected flush"),
    ],
)
def test_what_cannot_be_used_is_refused_and_not_added(call: dict[str, Any], fault: str) -> None:
    face = Live(Settings(lively=False))
    with pytest.raises(InputError, match=fault):
        face.say(**call)
    assert heard(face) == []


def test_the_rate_may_not_change_within_a_phrase() -> None:
    buffer = VoiceBuffer()
    buffer.add(np.zeros(100), 8_000)
    with pytest.raises(InputError, match="16,000 Hz after 8,000"):
        buffer.add(np.zeros(100), 16_000)
    buffer.flush()
    buffer.add(np.zeros(100), 16_000)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.integers(0, 3 * RATE), max_size=12), st.sampled_from(Known))
def test_phrases_do_not_depend_on_cuts(cuts: list[int], known: Known) -> None:
    times = np.arange(3 * RATE) / RATE
    sound = np.where((times % 1.4) < 0.9, 0.3 * np.sin(800 * times), 0.0)
    words = [("one,", 0.0, 0.5), ("two", 0.52, 0.9), ("three", 1.4, 2.3), ("four.", 2.3, 2.7)]

    def phrases(edges: list[int]) -> list[tuple[int, str, tuple[Any, ...], bool]]:
        buffer, found = VoiceBuffer(), []
        for start, end in pairwise(edges):
            new = [w for w in words if start <= w[1] * RATE < end] if known is Known.TIMES else ()
            text = "one, two three four." if known is Known.TEXT and start == 0 else ""
            found += buffer.add(sound[start:end], RATE, text=text, words=new)
        found += buffer.flush()
        return [(len(p.samples), p.text, p.words, p.is_open) for p in found]

    edges = [0, *sorted(cuts), len(sound)]
    first = next(edge for edge in edges if edge)
    whole = phrases([0, len(sound)])
    assert phrases([0, *[edge for edge in edges if edge >= first]]) == whole
    assert sum(samples for samples, *_ in whole) == len(sound)
    assert [p[-1] for p in whole] == [True] * (len(whole) - 1) + [False]
    if known is Known.TIMES:
        assert [[w.text for w in p[2]] for p in whole] == [["one,", "two"], ["three", "four."]]
        assert whole[1][2][0].start == pytest.approx(0.25)


def test_by_ear_a_phrase_ends_after_six_seconds_at_the_latest() -> None:
    buffer = VoiceBuffer()
    noise = 0.2 * np.random.default_rng(1).normal(size=RATE * 20).clip(-1, 1)
    noise[5 * RATE : 5 * RATE + 800] *= 0.5
    lengths = [phrase.duration for phrase in buffer.add(noise, RATE)]
    assert lengths[0] == pytest.approx(5.0, abs=0.06)
    assert max(lengths) <= LATEST


def test_words_take_their_marks_from_the_text() -> None:
    buffer = VoiceBuffer()
    words = [("Well", 0.0, 0.3), ("that", 0.35, 0.6), ("is", 0.6, 0.7), ("it", 0.7, 0.9)]
    assert buffer.add(np.zeros(RATE), RATE, text='Well, "that" is ', words=words[:3]) == []
    buffer.add(b"", RATE, text="it.", words=words[3:])
    (phrase,) = buffer.flush()
    assert [word.text for word in phrase.words] == ["Well,", 'that"', "is", "it."]


@pytest.mark.parametrize("known", list(Known))
def test_the_voice_is_played_whole_and_the_mouth_follows_it(
    spoken: Utterance, timed: list[tuple[str, float, float]], known: Known
) -> None:
    sound, rate = samples_of(spoken), spoken.audio.sample_rate
    face = Live(Settings(lively=False), fps=30)
    for start in range(0, len(sound), 1_111):
        span = start / rate, (start + 1_111) / rate
        words = [w for w in timed if span[0] <= w[1] < span[1]] if known is Known.TIMES else ()
        text = TEXT if known is Known.TEXT and start == 0 else ""
        face.say(text, audio=sound[start : start + 1_111].tobytes(), rate=rate, words=words)
    frames = heard(face)
    played = sound_of(frames)
    assert frames[0].sample_rate == rate
    np.testing.assert_array_equal(played[: len(sound)], sound)
    assert not played[len(sound) :].any()
    reference = speak(TEXT, text=True, settings=Settings(lively=False)).performance.values[:, JAW]
    jaw = np.array([frame.values[JAW] for frame in frames])[: len(reference)]
    likeness = np.corrcoef(jaw, reference[: len(jaw)])[0, 1]
    assert likeness > (0.8 if known is Known.NOTHING else 0.9)
    said = [frame.text for frame in frames if frame.text]
    if known is not Known.NOTHING:
        assert " ".join(dict.fromkeys(said)) == TEXT


@pytest.mark.parametrize(
    ("about", "fault"),
    [
        ({"words": [("Well,", 0.0, 9.0)]}, "'Well,' ends at 9 s, but the sound at"),
        ({"text": "Nothing of the kind was ever said in here, by nobody at all, my dear old friend."}, "fit"),
    ],
)
def test_what_the_sound_does_not_say_is_one_error_and_the_voice_is_heard(
    spoken: Utterance, about: dict[str, Any], fault: str
) -> None:
    sound, rate = samples_of(spoken), spoken.audio.sample_rate
    sound = sound[: round(1.0 * rate)] if "text" in about else sound
    face = Live(Settings(lively=False))
    face.say(audio=sound, rate=rate, **about)
    face.close()
    with pytest.raises(InputError, match=fault):
        next(face.frames())
    np.testing.assert_array_equal(sound_of(list(face.frames()))[: len(sound)], sound)


def test_silence_is_played_with_the_mouth_at_rest() -> None:
    face = Live(Settings(lively=False))
    face.say(audio=np.zeros(RATE), rate=RATE)
    frames = heard(face)
    assert len(frames) > 30
    assert {frame.text for frame in frames} == {""}
    assert np.ptp([frame.values[JAW] for frame in frames]) == pytest.approx(0.0, abs=1e-9)


def test_an_interrupted_voice_tells_what_was_not_said(
    spoken: Utterance, timed: list[tuple[str, float, float]]
) -> None:
    sound, rate = samples_of(spoken), spoken.audio.sample_rate
    face = Live(Settings(lively=False), fps=30)
    face.say(audio=sound, rate=rate, words=timed)
    frames = face.frames()
    for frame in frames:
        if frame.time > timed[1][1]:
            break
    assert face.interrupt() == TEXT.removeprefix("Well, that ")
    assert not sound_of(list(islice(frames, 30))).any()


def test_a_text_that_its_voice_has_not_said_yet_is_told_too(spoken: Utterance) -> None:
    sound, rate = samples_of(spoken), spoken.audio.sample_rate
    face = Live(Settings(lively=False), fps=30)
    cut = round(spoken.words[6].start * rate)
    face.say(TEXT, audio=sound[:cut], rate=rate)
    assert face.interrupt() == TEXT
    face.say("Now", audio=sound[:3_000], rate=rate)
    assert face.interrupt() == "Now"


def test_text_after_a_voice_is_spoken_after_it(spoken: Utterance) -> None:
    sound, rate = samples_of(spoken), spoken.audio.sample_rate
    face = Live(Settings(lively=False))
    face.say(TEXT, audio=sound, rate=rate)
    face.say("Oh.")
    texts = [frame.text for frame in heard(face) if frame.text]
    assert list(dict.fromkeys(texts))[-1] == "Oh."
