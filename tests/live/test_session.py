"""Live: the law over cuts and arrival, sound frame by frame, interruption, idle life, refusals."""

from __future__ import annotations

import asyncio
from fractions import Fraction
from functools import cache
from itertools import islice, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from risorius import Live
from risorius.core.parameters import INDEX, NAMES, PARAMETERS, Kind
from risorius.core.performance import Performance, frame_count
from risorius.core.score import Score
from risorius.core.speech.audio import AudioWriter
from risorius.core.speech.utterance import Phone, Utterance, Word
from risorius.errors import InputError, ParameterError, RisoriusError, SpeechError, UnusedSettingError
from risorius.face.fit.expressions import emotion_presets
from risorius.languages import language_of
from risorius.live.crossfade import CROSSFADE
from risorius.live.frame import LiveFrame
from risorius.live.pace import Pace
from risorius.live.sentences import SentenceBuffer
from risorius.rules.emotions import Displays
from risorius.settings import Settings
from risorius.take import Take

TEXT = (
    'Dr. Smith paid 3.50 for it... really. "Did he?" Yes! 1. One\n2. Two, e.g. this. '
    + "long " * 100
    + "End."
)
JAW = INDEX["masseter"]
MUSCLES = [INDEX[p.name] for p in PARAMETERS if p.kind is Kind.MUSCLE]
RATE = 16_000


def length(sentence: str) -> int:
    """Return the samples of a sentence."""
    return sum(map(ord, sentence)) % 997 * 24


def perform(text: str, feelings: Displays, chosen: Settings) -> Take:
    """Perform sentences at no cost: the letters of each give its value, its sound and its length."""
    if "engine dies" in text:
        raise SpeechError("the engine died")
    buffer, words, values, place = SentenceBuffer(language_of("en-us")), [], [], 0
    with AudioWriter(RATE) as writer:
        for piece in [*buffer.add(text), *buffer.flush()]:
            sentence = piece.strip()
            start, number = writer.frames / RATE, length(sentence)
            writer.append(np.arange(number).astype(np.int16))
            word = place + piece.index(sentence)
            words.append(Word(sentence, start, writer.frames / RATE, 0, 1, word, word + len(sentence)))
            values.append(number / 24 / 997 + chosen.seed * 1e-3 + len(feelings))
            place += len(piece)
        audio = writer.finish()
    score = Score(audio.duration)
    times = np.arange(frame_count(score.duration, chosen.fps)) / float(chosen.fps)
    ends = np.array([word.end for word in words])
    at = np.array(values)[np.minimum(np.searchsorted(ends, times, "right"), len(words) - 1)]
    silence = (Phone("", 0.0, score.duration),)
    utterance = Utterance(text, "en-us", audio, silence, tuple(words))
    return Take(Performance(score, chosen.fps, np.repeat(at[:, None], len(NAMES), 1)), chosen, utterance)


def live(fps: float = 30, chosen: Settings | None = None) -> Live:
    return Live(chosen or Settings(lively=False), fps=fps, perform=perform)


@cache
def whole() -> list[LiveFrame]:
    face = live()
    face.say(TEXT)
    face.close()
    return list(face.frames())


def same(left: list[LiveFrame], right: list[LiveFrame]) -> None:
    assert [f.text for f in left] == [f.text for f in right]
    for a, b in zip(left, right, strict=True):
        np.testing.assert_array_equal(a.values, b.values)
        np.testing.assert_array_equal(a.sound, b.sound)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(0, len(TEXT)), max_size=30))
def test_cuts_change_nothing(cuts: list[int]) -> None:
    edges = [0, *sorted(cuts), len(TEXT)]
    face = live()
    for start, end in pairwise(edges):
        face.say(TEXT[start:end])
    face.close()
    same(list(face.frames()), whole())


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 5), st.integers(60, len(TEXT)))
def test_pieces_in_time_give_the_frames_of_the_whole(frames: int, cut: int) -> None:
    face = live()
    face.say(TEXT[:cut])
    iterator = face.frames()
    early = list(islice(iterator, frames))
    face.say(TEXT[cut:])
    face.close()
    same([*early, *iterator], whole())


def test_a_sentence_waits_for_what_decides_its_end_or_a_second() -> None:
    face = live()
    face.say("It cost 3.")
    texts = [frame.text for frame in islice(face.frames(), 40)]
    assert texts[:30] == [""] * 30
    assert texts[30] == "It cost 3."


@pytest.mark.parametrize("fps", [24, 29.97, 60])
def test_frames_hold_their_samples_and_count_on(fps: float) -> None:
    face = live(fps)
    face.say("First one. Second one. Third.")
    face.close()
    frames = list(face.frames())
    assert [f.index for f in frames] == list(range(len(frames)))
    exact = Fraction(fps).limit_denominator(100_000)
    assert [len(f.sound) for f in frames] == [
        round((k + 1) * RATE / exact) - round(k * RATE / exact) for k in range(len(frames))
    ]
    heard = np.concatenate([f.sound for f in frames])
    said = [np.arange(length(text)).astype(np.int16) for text in ("First one.", "Second one.", "Third.")]
    number = sum(map(len, said))
    np.testing.assert_array_equal(heard[:number], np.concatenate(said))
    assert not heard[number:].any()


def test_an_interruption_silences_at_once_and_rests_within_a_fifth_of_a_second() -> None:
    face = live()
    face.say("zzzzzzz zzzz zzzz. Never said. Nor this")
    iterator = face.frames()
    spoken = list(islice(iterator, 8))
    assert spoken[-1].values[JAW] > 0.1
    assert face.interrupt() == "Never said. Nor this"
    after = list(islice(iterator, 60))
    assert not any(f.text or f.sound.any() for f in after)
    assert 0 < after[0].values[JAW] < spoken[-1].values[JAW]
    assert after[round(0.2 * 30)].values[JAW] == pytest.approx(0)
    face.say("Now. ")
    face.flush()
    assert next(iterator).text == "Now."


def test_values_pass_over_a_seam_without_a_jump() -> None:
    face = live(60)
    for number, text in enumerate(("A. ", "Zzzz zz. ", "Be. ")):
        face.say(text)
        face.flush()
        face.feel("happiness", number * 0.1)
    face.close()
    values = np.array([f.values for f in face.frames()])
    span = values.max() - values.min()
    assert np.abs(np.diff(values, axis=0)).max() <= 1.5 * span / (CROSSFADE * 60) + 1e-12


def test_an_idle_face_lives_and_instances_are_apart() -> None:
    first, second = live(10, Settings()), live(10, Settings())
    first.feel("happiness", 0.8)
    smiling = np.array([f.values for f in islice(first.frames(), 130)])
    calm = np.array([f.values for f in islice(second.frames(), 130)])
    assert np.ptp(calm, axis=0).max() > 0.1
    assert np.abs(smiling - calm).max() > 0.1


def test_an_avatar_is_as_happy_as_the_face_feels() -> None:
    face = Live(Settings(fps=Fraction(10), dynamics="static"))
    happy = emotion_presets().index("happy")
    plain = np.array([f.emotion for f in islice(face.frames(), 20)])
    assert plain.shape == (20, len(emotion_presets()))
    assert not plain.any()
    face.feel("happiness", 0.5)
    face.say("Good evening. ")
    face.close()
    glad = np.array([f.emotion for f in face.frames()])
    assert glad[:, happy].max() == pytest.approx(0.5, abs=0.01)
    assert np.abs(np.diff(np.vstack([plain, glad]), axis=0)).max() <= 0.1 / CROSSFADE


def test_feelings_hold_from_the_next_whole_sentence_on() -> None:
    face = live()
    face.say("Plain. Glad. ")
    face.feel("happiness", 0.5)
    face.close()
    last = {f.text: f.values[JAW] for f in face.frames()}
    assert last["Plain."] < 1 < last["Glad."]


def test_an_error_is_raised_once_and_the_face_goes_on() -> None:
    face = live()
    face.say("Here the engine dies. Good. ")
    face.close()
    with pytest.raises(SpeechError, match="the engine died"):
        list(face.frames())
    assert {f.text for f in face.frames()} == {"Good."}


def test_what_is_wrong_is_refused() -> None:
    face = live()
    for emotion, intensity, message in (("glee club", 0.5, "emotion"), ("happiness", 1.5, "out of range")):
        with pytest.raises(RisoriusError, match=message):
            face.feel(emotion, intensity)
    with pytest.raises(ParameterError, match="out of range"):
        face.feel("happiness", float("nan"))
    with pytest.raises(InputError, match="smaller pieces"):
        face.say("a" * 100_001)
    with pytest.raises(InputError, match="fps"):
        live(0)
    face.close()
    with pytest.raises(InputError, match="after close"):
        face.say("More.")
    assert list(face.frames()) == []


def test_paced_and_async_forms_yield_the_same_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Pace, "wait", lambda *_: 0.0)

    async def collect() -> list[LiveFrame]:
        return [frame async for frame in face.aframes()]

    face = live(10)
    face.say("A.")
    face.close()
    frames = asyncio.run(collect())
    for paced in (False, True):
        again = live(10)
        again.say("A.")
        again.close()
        same(frames, list(again.frames(paced=paced)))


def test_pauses_that_nothing_reads_are_refused() -> None:
    for chosen in (Settings(lead=1.0), Settings(tail=2.0)):
        with pytest.raises(UnusedSettingError, match="sets its own pauses"):
            live(30, chosen)


def test_what_joins_is_told_when_it_is_interrupted_or_cannot_be_said() -> None:
    face = live()
    face.say("Aaaa aaaa aaaa aaaa. Bbbb. ")
    face.flush()
    iterator = face.frames()
    next(iterator)
    face.say("Joins. ")
    face.flush()
    next(iterator)
    assert face.waiting == 1
    assert face.interrupt().endswith("Joins.")
    assert face.waiting == 0
    face.say("Aaaa aaaa aaaa aaaa. ")
    face.flush()
    next(iterator)
    face.say("Here the engine dies. Better. ")
    face.close()
    said: list[LiveFrame] = []
    with pytest.raises(SpeechError, match="the engine died"):
        said += iterator
    said += face.frames()
    assert list(dict.fromkeys(f.text for f in said if f.text))[-1] == "Better."


def test_a_smile_goes_on_from_one_idle_stretch_to_the_next() -> None:
    face = live(10, Settings())
    face.feel("happiness", 0.8)
    smile = [f.parameters["zygomatic_major.left"] for f in islice(face.frames(), 130)]
    assert min(smile[20:]) > 0.8 * max(smile) > 0.1


def test_sentences_that_cannot_be_spoken_together_are_spoken_one_by_one() -> None:
    face = live()
    face.say("Good words to say now. Here the engine dies. Better. ")
    face.close()
    texts = []
    with pytest.raises(SpeechError):
        texts += [frame.text for frame in face.frames()]
    texts += [frame.text for frame in face.frames()]
    assert texts[-1] == "Better."


def test_a_spoken_sentence_has_its_voice_and_ends_at_rest() -> None:
    face = Live(fps=30)
    face.say("Hello there.")
    face.close()
    frames = list(face.frames())
    assert len({f.text for f in frames}) == 1
    assert np.abs(np.concatenate([f.sound for f in frames])).max() > 1_000
    assert frames[3].parameters.keys() == set(NAMES)
