"""A turn: sentences that are performed together, as `speak` performs a text, and others that join them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil

import numpy as np

from ..core.arrays import Array
from ..core.audio import Samples
from ..rules.emotions import Displays
from ..settings import Settings
from ..take import Take
from .waiting import LiveSentence

SEAM = 0.15
"""Seconds in which the face passes from one stretch to the next: an interrupted mouth shuts within .2 s."""
TAIL = 0.35
"""Seconds of silence behind a sentence; with the seam before the next they make its pause."""
MOST_SENTENCES = 8
"""Sentences of a turn. Each that joins performs the turn anew, so that the cost of joining is bounded."""
LAST_CALL = 0.9
"""Seconds before a turn's end after which no sentence joins it (DESIGN, section 6)."""
PREROLL = 1.0
"""Seconds in which emotions that are shown already rise before a stretch; they are not played."""

PerformSentence = Callable[[str, Displays, Settings], Take]


@dataclass(frozen=True, slots=True)
class LiveStretch:
    """What is played: values (frames, parameters) and samples, from the face's frame `first` on.

    `sentences`: what is said, none if nothing is; `spoken`: their text, and as `labels` that of each.
    `starts`: seconds at which each begins. `words`: seconds and first character of each.
    """

    first: int
    values: Array
    samples: Samples
    sample_rate: int
    sentences: tuple[LiveSentence, ...] = ()
    spoken: str = ""
    labels: tuple[str, ...] = ()
    starts: tuple[float, ...] = ()
    words: tuple[tuple[float, int], ...] = ()
    feelings: Displays = ()

    @property
    def end(self) -> int:
        """The frame after the last."""
        return self.first + len(self.values)

    def sentence_at(self, seconds: float) -> str:
        """Return the sentence that is being said so many seconds after `first`."""
        return self.labels[max(bisect_right(self.starts, seconds) - 1, 0)] if self.labels else ""

    def unsaid_after(self, seconds: float) -> str:
        """Return the text from the first word on that begins later than that."""
        later = [character for start, character in self.words if start > seconds]
        return self.spoken[later[0] :] if later else ""

    def last_call(self, fps: Fraction) -> int:
        """Return the last frame before which sentences may join."""
        return max(self.first, self.end - ceil(LAST_CALL * fps))


def stretch_of(
    take: Take,
    sentences: tuple[LiveSentence, ...],
    texts: tuple[str, ...],
    first: int,
    feelings: Displays,
    rate: int,
) -> LiveStretch:
    """Return what a take plays from the frame `first` on; `rate` is that of a take without sound.

    `texts`: those of the sentences, with the blanks between them.
    """
    samples = np.zeros(0, np.int16)
    if take.audio is not None:
        samples, rate = take.audio.read(), take.audio.sample_rate
    words: tuple[tuple[float, int], ...] = ()
    if take.utterance is not None:
        words = tuple((word.start, word.source_start) for word in take.utterance.words)
    starts, character = [], 0
    for text in filter(None, texts):
        first_words = [start for start, place in words if place >= character]
        starts.append(first_words[0] if first_words else 0.0)
        character += len(text)
    values, labels = take.performance.values, tuple(text.strip() for text in texts if text)
    return LiveStretch(
        first, values, samples, rate, sentences, "".join(texts), labels, tuple(starts), words, feelings
    )


def prerolled(settings: Settings) -> tuple[Settings, int]:
    """Return settings whose lead is longer, and the frames that are not played of it."""
    frames = ceil(PREROLL * settings.fps)
    return replace(settings, lead=settings.lead + float(frames / settings.fps)), frames
