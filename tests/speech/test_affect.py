"""Emotion in the voice: what is said under it, and how much."""

import numpy as np
import pytest

from risorius.api import speak
from risorius.core.speech.utterance import Utterance
from risorius.core.speech.voice_style import PLAIN
from risorius.errors import ParameterError
from risorius.rules.emotions import Display
from risorius.rules.voice_emotion import voice_manner
from risorius.script import read_script
from risorius.script.markup import parse_markup
from risorius.settings import Settings
from risorius.speech import feelings, synthesize_script

TEXT = "Nobody ever told me. Nobody ever told me."


def spoken(*displays: Display) -> Utterance:
    script = read_script(TEXT, text=True)
    return synthesize_script(script, felt=feelings(script, displays))


def loudness(said: Utterance, word: int) -> float:
    sound = np.concatenate(list(said.audio.blocks())).astype(float)
    span = said.words[word]
    rate = said.audio.sample_rate
    return float(np.sqrt((sound[round(span.start * rate) : round(span.end * rate)] ** 2).mean()))


def test_an_unknown_emotion_is_an_error() -> None:
    with pytest.raises(ParameterError, match="unknown emotion 'hapiness'"):
        voice_manner({"hapiness": 1.0})


def test_no_emotion_changes_nothing() -> None:
    assert voice_manner({}) == PLAIN
    assert voice_manner({"anger": 0.0}) == PLAIN


@pytest.mark.parametrize("name", ["anger", "disgust", "fear", "happiness", "sadness", "surprise"])
def test_changes_are_linear_in_the_intensity(name: str) -> None:
    half, full = voice_manner({name: 0.5}), voice_manner({name: 1.0})
    assert full != PLAIN
    assert half.pitch == pytest.approx(0.5 * full.pitch)
    assert half.volume == pytest.approx(0.5 * full.volume)
    for field in ("rate", "range", "pauses"):
        assert getattr(half, field) - 1.0 == pytest.approx(0.5 * (getattr(full, field) - 1.0))


def test_mixed_emotions_do_not_pile_up() -> None:
    mixed, anger = voice_manner({"anger": 1.0, "happiness": 1.0}), voice_manner({"anger": 1.0})
    assert mixed.volume < anger.volume


@pytest.mark.parametrize(
    ("name", "slower"), [("sadness", True), ("disgust", True), ("fear", False), ("anger", False)]
)
def test_directions_of_the_rate(name: str, slower: bool) -> None:
    plain, moved = spoken(), spoken(Display(name, 1.0))
    assert (moved.duration > plain.duration) == slower


def test_an_emotion_over_a_span_changes_the_words_in_it() -> None:
    plain = spoken()
    moved = spoken(Display("anger", 1.0, plain.words[4].start, None))
    assert loudness(moved, 1) == pytest.approx(loudness(plain, 1), rel=0.1)
    assert loudness(moved, 5) > 1.3 * loudness(plain, 5)


def test_a_display_in_markup_changes_the_voice_from_its_word_on() -> None:
    line = f'<PHONEME time="0" text="{TEXT}" />'
    plain, marked = (
        parse_markup(line + more) for more in ("", '<EMOTIONDISPLAY time="word:5" sadness="1" />')
    )
    before, after = synthesize_script(plain), synthesize_script(marked, felt=feelings(marked, ()))
    assert after.words[2].end - after.words[2].start == pytest.approx(
        before.words[2].end - before.words[2].start, abs=0.02
    )
    assert after.words[7].end - after.words[4].start > 1.1 * (before.words[7].end - before.words[4].start)


def test_it_can_be_switched_off() -> None:
    plain = speak(TEXT, text=True)
    moved = speak(TEXT, text=True, emotion={"sadness": 1.0})
    silenced = speak(TEXT, text=True, emotion={"sadness": 1.0}, settings=Settings(voice_emotion=False))
    assert silenced.duration == plain.duration
    assert moved.duration > plain.duration
