"""The queue of a live face: text and voice that are not said yet, and the emotions felt with them."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..core.speech.characters import shown
from ..errors import InputError, warn
from ..languages import language_of
from ..rules.emotions import Display, Displays
from ..script.tree import ScriptWarning
from .hearing import Hearing, texts_of
from .sentences import SentenceBuffer
from .voice import VoiceBuffer, VoicedPhrase

MOST_WAITING = 1_000
"""Sentences that may wait to be said."""


@dataclass(frozen=True, slots=True, eq=False)
class LiveSentence:
    """A sentence to be said: a text, or the phrase of a `voice` at `rate` Hz, and the emotions that were felt
    when it became whole.
    """

    text: str
    feelings: Displays
    voice: Hearing | None = None
    rate: int = 0

    def said(self) -> str:
        """Return the text, with the blanks after it, as it is shown."""
        return shown(self.text) if self.voice is None else texts_of([self.voice.result()])[0]

    @property
    def is_heard(self) -> bool:
        """Whether its words and their times are known."""
        return self.voice is None or self.voice.done()

    def joins(self, first: LiveSentence) -> bool:
        """Tell whether it can be performed together with the first sentence of a turn."""
        return self.feelings == first.feelings and self.rate == first.rate


class SentenceQueue:
    """Sentences that wait, in order, and the last one, which is not whole yet.

    `hear` hears a phrase of a voice, after the one before it if there is one. `format`: that of the text.
    """

    def __init__(
        self,
        language: str,
        hear: Callable[[VoicedPhrase, str, Hearing | None], Hearing],
        format: str | None = None,
    ) -> None:
        self._language, self._hear_later = language, hear
        self._text, self._voice = SentenceBuffer(language_of(language), format, self._tell), VoiceBuffer()
        self._told: set[str] = set()
        # The phrase before, which the next one of the same voice goes on from.
        self._before: Hearing | None = None
        self._whole: deque[LiveSentence] = deque()
        self._feelings: dict[str, float] = {}

    @property
    def is_unfinished(self) -> bool:
        """Tell whether something waits for its end."""
        return bool(self._text) or bool(self._voice)

    def __len__(self) -> int:
        return len(self._whole)

    @property
    def felt(self) -> Displays:
        """The emotions that are felt now."""
        return tuple(Display(name, amount) for name, amount in self._feelings.items() if amount)

    def feel(self, emotion: str, intensity: float) -> None:
        """Feel an emotion with the sentences that become whole from now on."""
        self._feelings[emotion] = intensity

    def add_text(self, text: str) -> None:
        """Add text; a voice that waits for its end ends. Raises InputError if too much waits."""
        self._check()
        self._hear(self._voice.flush())
        self._queue(self._text.add(text))

    def add_voice(
        self,
        audio: ArrayLike | bytes,
        rate: int,
        encoding: str,
        text: str,
        words: Iterable[tuple[str, float, float]],
    ) -> None:
        """Add a piece of a voice; text that waits for its end ends. InputError for a bad rate or words."""
        self._check()
        phrases = self._voice.add(audio, rate, encoding, text, words)
        self._queue(self._text.flush())
        self._hear(phrases)

    def end(self) -> None:
        """End the text and the voice that wait for their end."""
        self._queue(self._text.flush())
        self._hear(self._voice.flush())

    def take(
        self,
        first: LiveSentence | None,
        most: int,
        characters: float = math.inf,
        *,
        heard: bool = False,
    ) -> tuple[LiveSentence, ...]:
        """Take at most `most` that can be performed together with `first`, or else with each other; stop at
        `characters`. With `heard`, those that are not heard yet go on waiting."""
        taken: list[LiveSentence] = []
        while self._whole and len(taken) < most:
            following = self._whole[0]
            enough = sum(len(sentence.text) for sentence in taken) >= characters
            if enough or (heard and not following.is_heard) or not (first is None or following.joins(first)):
                break
            taken.append(self._whole.popleft())
            first = first or following
        return tuple(taken)

    def next_of(self, first: LiveSentence) -> LiveSentence | None:
        """Return the next sentence, if it is heard and can be performed together with the first."""
        following = self._whole[0] if self._whole else None
        return following if following and following.is_heard and following.joins(first) else None

    def put_back(self, sentences: Iterable[LiveSentence]) -> None:
        """Let sentences wait again, before all others."""
        self._whole.extendleft(reversed(tuple(sentences)))

    def clear(self) -> str:
        """Forget all; return its text."""
        unsaid = [sentence.said() for sentence in self._whole]
        if self._before is not None:
            unsaid.append(self._before.result().rest)
        unsaid += [self._voice.text, *map(shown, self._text.flush())]
        self._voice.flush()
        self._before = None
        self._whole.clear()
        return "".join(unsaid)

    def _tell(self, name: str) -> None:
        """Warn, once for each kind, of what is left out of Markdown."""
        if name not in self._told:
            self._told.add(name)
            warn(f"live: read as Markdown; left out: {name}", ScriptWarning)

    def _check(self) -> None:
        if len(self._whole) >= MOST_WAITING:
            raise InputError(f"{MOST_WAITING:,} sentences wait already; expected text as it is said")

    def _queue(self, sentences: list[str]) -> None:
        self._whole.extend(LiveSentence(text, self.felt) for text in sentences)

    def _hear(self, phrases: list[VoicedPhrase]) -> None:
        for phrase in phrases:
            heard = self._hear_later(phrase, self._language, self._before)
            self._before = heard if phrase.is_open else None
            self._whole.append(LiveSentence("", self.felt, heard, phrase.sample_rate))
