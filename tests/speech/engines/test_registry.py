"""Another engine is a registered function; synthesis needs nothing but the protocol."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from risorius.errors import InputError, ParameterError, SpeechWarning
from risorius.speech.engines.protocol import Rendition, SpeechRequest, SpokenPhone, Voice
from risorius.speech.engines.registry import ENGINES, load_engine
from risorius.speech.synthesis import synthesize_line


class Beeper:
    """Says "ba" for every word of a text, 0.2 s each."""

    def __init__(self, rate: int = 8000, guessed: tuple[str, ...] = (), mute: bool = False) -> None:
        self.rate = rate
        self.guessed = guessed
        self.mute = mute

    def synthesize(self, request: SpeechRequest) -> Rendition:
        words = [] if self.mute else request.text.split()
        phones, position = [], 0
        for index, word in enumerate(words):
            position = request.text.index(word, position)
            start = round(0.2 * index * self.rate)
            phones.append(SpokenPhone("B", start, -1, 0, position))
            phones.append(SpokenPhone("AA", start + round(0.1 * self.rate), 2, 0, position))
            position += len(word)
        samples = np.zeros(round(0.2 * self.rate * max(len(words), 1)), np.int16)
        return Rendition(samples, self.rate, tuple(phones), self.guessed)

    def transcribe(self, words: Sequence[str], voice: Voice) -> tuple[tuple[str, ...], ...]:
        return tuple(("B", "AA") for _ in words)

    def voices(self) -> tuple[Voice, ...]:
        return (Voice("en-us", ("en-us",), "", "A beeper", "beep"),)

    def close(self) -> None: ...


def test_an_unknown_engine_is_reported_with_the_nearest() -> None:
    with pytest.raises(ParameterError, match="unknown speech engine 'espeek'; did you mean 'espeak'"):
        load_engine("espeek")


def test_another_engine_by_registration() -> None:
    ENGINES.register("beeper")(Beeper)
    try:
        said = synthesize_line("Two words.", engine=load_engine("beeper"), lead=0.1)
    finally:
        ENGINES.forget("beeper")
    assert said.audio.sample_rate == 8000
    assert [phone.symbol for phone in said.phones] == ["", "B", "AA", "B", "AA"]
    assert [(word.text, round(word.start, 3)) for word in said.words] == [("Two", 0.1), ("words", 0.3)]


def test_guessed_sounds_are_reported() -> None:
    with pytest.warns(SpeechWarning, match="no mouth shape for 'ǁ': using the nearest phone class"):
        synthesize_line("Word.", engine=Beeper(guessed=("ǁ",)))


def test_an_engine_that_says_nothing() -> None:
    with pytest.raises(InputError, match="nothing in the text can be spoken by this voice"):
        synthesize_line("Word.", engine=Beeper(mute=True))
