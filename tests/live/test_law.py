"""The law: text that is there in time gives the frames that `speak` gives for it, a late piece a pause."""

from __future__ import annotations

from functools import cache
from itertools import islice, pairwise
from math import ceil

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from risorius import Live, speak
from risorius.core.parameters import INDEX, NAMES
from risorius.languages import language_of
from risorius.live import session, turn
from risorius.live.crossfade import CROSSFADE
from risorius.live.frame import LiveFrame
from risorius.live.performer import perform_sentence
from risorius.live.sentences import SentenceBuffer
from risorius.live.turn import LAST_CALL, TAIL
from risorius.rules.emotions import Displays
from risorius.settings import Settings
from risorius.take import Take

PARAGRAPH = (
    "I like it very much here, and she likes popcorn. What do you like? My baby brother put the map by the "
    "beam. Well, who knows. You may ask her yourself when she comes back on Monday. Everybody else has gone "
    "away. It is 3.50 now. No, I do not believe a word of it! Is it true? She said that nobody in the whole "
    "house, neither the children nor their parents, had seen a thing. Oh. Bring the ball. That is all."
)


@cache
def spoken(text: str, feelings: Displays, seed: int) -> Take:
    """Perform sentences as a live face does by default; the same ones are performed once."""
    return perform_sentence(text, feelings, Settings(lead=CROSSFADE, tail=TAIL, seed=seed))


def talking() -> Live:
    return Live(perform=lambda text, felt, chosen: spoken(text, felt, chosen.seed))


def offline(text: str, seed: int = 0) -> Take:
    return spoken(text + " ", (), seed)


def close_to(frames: list[LiveFrame], take: Take) -> None:
    """Check that frames are those of a take, and that its sound is theirs."""
    np.testing.assert_allclose([f.values for f in frames], take.performance.values, atol=1e-6)
    sound_of(frames, take)


def sound_of(frames: list[LiveFrame], take: Take) -> None:
    """Check that the sound of frames is that of a take."""
    assert take.audio is not None
    heard, sound = np.concatenate([f.sound for f in frames]), take.audio.read()
    shorter = min(len(heard), len(sound))
    np.testing.assert_array_equal(heard[:shorter], sound[:shorter])


@settings(max_examples=8, deadline=None)
@given(st.lists(st.integers(0, len(PARAGRAPH)), max_size=40))
def test_a_long_text_in_any_pieces_gives_the_frames_of_speak(cuts: list[int]) -> None:
    """A turn begins with some of its sentences; the others join it while it plays."""
    face = talking()
    for start, end in pairwise([0, *sorted(cuts), len(PARAGRAPH)]):
        face.say(PARAGRAPH[start:end])
    face.close()
    frames = list(face.frames())
    assert len(frames) == len(offline(PARAGRAPH).performance.values)
    close_to(frames, offline(PARAGRAPH))


FIRST, SECOND, THIRD = "Hello there, my dear friend. ", "I like it very much here, you know. ", "Who are you?"


def check_joining(first: int, second: int, cuts: list[int]) -> None:
    """Check that frames are those of the whole, from the first to the last."""
    face, taken = talking(), offline(FIRST + SECOND + THIRD)
    face.say(FIRST + "I")
    iterator = face.frames()
    frames = list(islice(iterator, first))
    rest = SECOND[1:] + THIRD
    cut = sorted({min(c, len(rest)) for c in cuts} | {len(SECOND) + 1})
    for start, end in pairwise([0, *cut, len(rest)]):
        face.say(rest[start:end])
        if end == cut[-1]:
            frames += islice(iterator, second)
    face.close()
    frames += iterator
    assert len(frames) == len(taken.performance.values)
    close_to(frames, taken)


@settings(max_examples=12, deadline=None)
@example(first=1, second=28, cuts=[47])
@given(st.integers(1, 25), st.integers(0, 28), st.lists(st.integers(0, len(SECOND + THIRD)), max_size=5))
def test_sentences_that_join_in_time_give_the_frames_of_the_whole(
    first: int, second: int, cuts: list[int]
) -> None:
    check_joining(first, second, cuts)


@pytest.mark.full
@settings(max_examples=150, deadline=None)
@example(first=1, second=28, cuts=[47])
@given(st.integers(1, 25), st.integers(0, 28), st.lists(st.integers(0, len(SECOND + THIRD)), max_size=5))
def test_sentences_join_in_time_whenever_they_come(first: int, second: int, cuts: list[int]) -> None:
    check_joining(first, second, cuts)


@pytest.mark.parametrize("early", [0, 9])
def test_sentences_that_come_one_by_one_at_the_last_moment_give_the_frames_of_the_whole(early: int) -> None:
    """Each becomes whole .9 s before the end of what was said before it."""
    sentences = [*SentenceBuffer(language_of("en-us")).add(PARAGRAPH + " Oh")]
    face = talking()
    iterator, frames = face.frames(), []
    for number, sentence in enumerate(sentences):
        if number:
            before = offline("".join(sentences[:number]).strip())
            call = len(before.performance.values) - ceil(LAST_CALL * 30)
            frames += islice(iterator, call - early - len(frames))
        face.say(sentence)
        face.flush()
    face.close()
    close_to([*frames, *iterator], offline(PARAGRAPH))


def test_a_turn_that_nothing_joins_in_time_ends_as_one_that_nothing_follows() -> None:
    taken, face = offline(FIRST.strip()), talking()
    length = len(taken.performance.values)
    face.say(FIRST + "I like")
    iterator, frames = face.frames(), []
    while len(frames) < length:
        # Whoever writes goes on, but ends no sentence.
        face.say(" it")
        frames += islice(iterator, 15)
    close_to(frames[:length], taken)


@settings(max_examples=8, deadline=None)
@given(st.integers(0, 90))
def test_a_late_piece_is_the_performance_with_a_pause_of_that_length_there(late: int) -> None:
    face, before, after = talking(), offline(FIRST.strip()), offline(THIRD, seed=1)
    face.say(FIRST)
    face.flush()
    iterator = face.frames()
    frames = list(islice(iterator, len(before.performance.values) + late))
    face.say(THIRD)
    face.close()
    frames += iterator
    begun = next(f.index for f in frames if f.text == THIRD)
    assert begun == len(before.performance.values) + late
    close_to(frames[: len(before.performance.values)], before)
    assert not any(f.sound.any() for f in frames[len(before.performance.values) : begun])
    seam = round(CROSSFADE * 30)
    values = after.performance.values[seam:]
    np.testing.assert_allclose([f.values for f in frames[begun + seam :]], values, atol=1e-6)
    assert after.audio is not None
    heard = np.concatenate([f.sound for f in frames[begun:]])
    sound = after.audio.read()[: len(heard)]
    # Frames hold their samples by the face's own time, so that a turn's sound may begin one sample later.
    length = len(sound) - 1
    assert any(np.array_equal(heard[k : k + length], sound[:length]) for k in (0, 1))


def test_the_frames_are_those_of_speak() -> None:
    text = "Hello there. Who are you?"
    chosen = Settings(lead=CROSSFADE, tail=TAIL)
    take = speak(text, text=True, emotion={"happiness": 0.7}, settings=chosen)
    face = Live()
    face.feel("happiness", 0.7)
    for piece in ("Hel", "lo there. Wh", "o are you?"):
        face.say(piece)
    face.close()
    close_to(list(face.frames()), take)


@pytest.mark.parametrize("frame", [9, 16, 24, 33, 41, 50])
def test_who_is_interrupted_shuts_the_mouth_and_looks_at_the_listener(frame: int) -> None:
    face = talking()
    face.say(FIRST + SECOND)
    face.flush()
    iterator = face.frames()
    before = list(islice(iterator, frame))
    unsaid = face.interrupt()
    after = list(islice(iterator, 45))
    assert unsaid
    assert (FIRST + SECOND).strip().endswith(unsaid)
    assert not any(f.sound.any() for f in after)
    opening = [INDEX[name] for name in ("masseter", "depressor_labii.left", "levator_labii_superioris.left")]
    jaw = np.array([f.values[opening] for f in [before[-1], *after]])
    # Within .2 s: by the sixth frame at 30 a second.
    assert jaw[6:].max() < 0.02
    assert np.abs(np.diff(jaw, axis=0)).max() < 0.5
    for angle in ("pitch", "yaw"):
        gaze = [f.parameters[f"gaze_{angle}"] + f.parameters[f"head_{angle}"] for f in after[15:]]
        assert np.abs(gaze).max() < 4.0


def test_what_goes_beyond_the_longest_turn_follows_without_a_jump(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pause is like any other, and nothing is done that would end a turn."""
    for name in ("MOST_SENTENCES", "FEW_SENTENCES"):
        for module in (turn, session):
            monkeypatch.setattr(module, name, 4)
    names = ("him", "her", "it", "them", "Tom", "Ann", "Bob", "you")
    text = "".join(f"I saw {name} there. " for name in names)
    face = talking()
    face.say(text)
    face.close()
    frames = list(face.frames())
    half = text.index("I saw Tom")
    longer, after = offline(text[: text.index("I saw Ann")].strip()), offline(text[half:].strip(), seed=1)
    assert longer.utterance is not None
    border = round((longer.utterance.words[16].start - CROSSFADE) * 30)
    np.testing.assert_allclose(
        [f.values for f in frames[:border]], longer.performance.values[:border], atol=1e-6
    )
    sound_of(frames[:border], longer)
    assert abs(len(frames) - len(offline(text.strip()).performance.values)) <= 1
    seam = round(CROSSFADE * 30)
    values = after.performance.values[seam:]
    np.testing.assert_allclose([f.values for f in frames[border + seam :]], values, atol=1e-6)
    steps = np.abs(np.diff([f.values for f in frames], axis=0))
    before = steps[: border - 1].max(axis=0)
    mouth = [k for k, name in enumerate(NAMES) if "gaze" not in name and "head" not in name]
    assert (steps[border - 1 : border + seam, mouth] < before[mouth] + 0.1).all()
    ends = [frame.text for frame in frames].index("I saw Tom there.")
    assert abs(ends - border) <= 1
