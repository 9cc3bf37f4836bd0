"""Shared builders: small utterances that need no speech engine."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

import pytest

from risorius.core.audio import silence
from risorius.core.utterance import Pause, PauseKind, Phone, Utterance, Word
from risorius.pipeline import speak
from risorius.settings import Settings
from risorius.take import Take

VOWELS = frozenset({"AA", "AE", "AH", "AO", "AW", "AY", "EH", "ER", "EY", "IH", "IY", "OW", "OY", "UH", "UW"})
UtteranceMaker = Callable[..., Utterance]


@pytest.fixture
def utterance_of() -> UtteranceMaker:
    """Return a function from ARPAbet symbols ("_" for a pause) to an utterance, a word per phone."""

    def make(symbols: str, seconds: float = 0.1, lead: float = 0.5, tail: float = 0.5) -> Utterance:
        rate = 22_050
        spans: list[tuple[str, float]] = [("", lead)]
        spans += [("" if s == "_" else s, 0.2 if s == "_" else seconds) for s in symbols.split()]
        spans.append(("", tail))
        phones: list[Phone] = []
        words: list[Word] = []
        pauses: list[Pause] = []
        edge = 0
        for number, (symbol, length) in enumerate(spans):
            start, edge = edge / rate, edge + round(length * rate)
            end = edge / rate
            if symbol:
                stress = 2 if symbol in VOWELS else -1
                phones.append(Phone(symbol, start, end, stress, len(words)))
                words.append(Word(symbol.lower(), start, end, number, number + 1, number, number + 1))
            else:
                kind = PauseKind.INITIAL if number == 0 else PauseKind.COMMA
                kind = PauseKind.FINAL if number == len(spans) - 1 else kind
                phones.append(Phone("", start, end))
                pauses.append(Pause(start, end, kind))
        text = " ".join(w.text for w in words)
        audio = silence(edge / rate, rate)
        return Utterance(text, "en-us", audio, tuple(phones), tuple(words), pauses=tuple(pauses))

    return make


@pytest.fixture(scope="session")
def clip() -> Take:
    """A short sentence, performed by the standard head without inertia at 10 frames per second."""
    settings = Settings(fps=Fraction(10), dynamics="static", lead=0.3, tail=0.3)
    return speak("Oh, my mother!", emotion={"happiness": 0.5}, settings=settings)
