"""Perform a turn's text and hear a voice, in the thread that asks for it."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np

from ..core.arrays import Array
from ..core.speech.audio import Samples
from ..errors import warnings_to
from ..face.fit.expressions import emotion_weights
from ..pipeline import perform
from ..rules.emotions import Displays
from ..script import read_script
from ..settings import Settings
from ..speech import SynthesisCache
from ..speech.engines.registry import is_voice_file, load_engine
from ..speech.engines.voices import find_voice
from ..take import Take
from . import hearing
from .hearing import HeardPhrase, Hearing
from .threads import threads
from .voice import VoicedPhrase

PerformSentence = Callable[[str, Displays, Settings], Take]
"""Performs a text with the emotions felt."""


def perform_sentence(
    text: str,
    feelings: Displays,
    settings: Settings,
    before: SynthesisCache | None = None,
) -> Take:
    """Perform sentences as `speak` does.

    Speech from `before` is not spoken again; what is spoken is added to it.
    """
    script = read_script(text, text=True, source="live")
    return perform(script, feelings, settings, before=before)


def language_spoken(settings: Settings) -> str:
    """Return the code of the language that is spoken."""
    if settings.language is not None or settings.voice is None or is_voice_file(settings.voice):
        return settings.language or "en-us"
    return find_voice(settings.voice, None, load_engine()).language


@dataclass(frozen=True, slots=True)
class Played:
    """The playback of a take: the parameters' values (frames, parameters), its sound, and the second and the
    character at which each word begins. `sample_rate` is None without sound. `emotion`: the weights of VRM's
    presets that emotions alone move, (frames, 4).
    """

    values: Array
    emotion: Array
    samples: Samples
    sample_rate: int | None
    words: tuple[tuple[float, int], ...]


def played(take: Take) -> Played:
    """Return the playback of a take."""
    samples, rate = np.zeros(0, np.int16), None
    if take.audio is not None:
        samples, rate = take.audio.read(), take.audio.sample_rate
    words_said = () if take.utterance is None else take.utterance.words
    words = tuple((word.start, word.source_start) for word in words_said)
    emotion = emotion_weights(take.emotion_curves())
    return Played(take.performance.values, emotion, samples, rate, words)


class TurnPerformer(Protocol):
    """Performs for live faces. All methods may be called from any thread, and may raise RisoriusError."""

    @property
    def threads(self) -> int:
        """The number of threads that may ask at a time."""
        ...

    @property
    def may_move(self) -> bool:
        """Whether another process could do the same, and does not yet."""
        ...

    def text(self, text: str, feelings: Displays, settings: Settings) -> Played:
        """Perform a text."""
        ...

    def voice(self, phrases: Sequence[HeardPhrase], feelings: Displays, settings: Settings) -> Played:
        """Perform phrases of a voice that follow one another."""
        ...

    def hear(self, phrase: VoicedPhrase, language: str) -> HeardPhrase:
        """Return the timed words of a voice's phrase."""
        ...


class LocalPerformer:
    """Performs in the thread that asks, texts by `perform`.

    It keeps what it has spoken lately: a turn that grows is spoken only where it has grown.
    """

    def __init__(self, perform: PerformSentence = perform_sentence) -> None:
        self._before = SynthesisCache()
        self._is_plain = perform is perform_sentence
        self._perform = partial(perform_sentence, before=self._before) if self._is_plain else perform

    @property
    def threads(self) -> int:
        """As many as there are processors."""
        return os.cpu_count() or 1

    @property
    def may_move(self) -> bool:
        """Whether no other `perform` was given."""
        return self._is_plain

    def text(self, text: str, feelings: Displays, settings: Settings) -> Played:
        """Perform a text."""
        return played(self._perform(text, feelings, settings))

    def voice(self, phrases: Sequence[HeardPhrase], feelings: Displays, settings: Settings) -> Played:
        """Perform phrases of a voice."""
        measure = self._before.pitch.measure
        return played(hearing.perform_voice(phrases, feelings, settings, measure=measure))

    def hear(self, phrase: VoicedPhrase, language: str) -> HeardPhrase:
        """Return the timed words of a phrase."""
        with warnings_to(lambda line: None):
            return hearing.hear_phrase(phrase, language)


def hear_later(
    performer: TurnPerformer, phrase: VoicedPhrase, language: str, before: Hearing | None
) -> Hearing:
    """Hear a phrase in another thread, after the one before it, which may have left some of the text."""
    return threads("hear", performer.threads).submit(_hear_after, performer, phrase, language, before)


def _hear_after(
    performer: TurnPerformer, phrase: VoicedPhrase, language: str, before: Hearing | None
) -> HeardPhrase:
    rest = "" if before is None else before.result().rest
    return performer.hear(replace(phrase, text=rest + phrase.text), language)
