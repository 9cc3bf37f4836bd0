"""A turn: sentences that are performed together, as `speak` performs a text, and others that join them."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import ceil

from ..core.arrays import Array
from ..core.speech.audio import Samples
from ..errors import RisoriusError
from ..rules.emotions import Displays
from ..settings import Settings
from .hearing import texts_of
from .performer import Played, TurnPerformer
from .sentence_queue import LiveSentence

TAIL = 0.35
"""Seconds of silence behind a sentence; with the seam before the next they make its pause."""
FIRST_CHARACTERS = 100
"""Characters with which a turn begins, if it has as many: the others join it while it plays."""
FEW_SENTENCES, GROWTH, MOST_SENTENCES = 8, 4, 64
"""Sentences of a turn, at most 64. Joining performs a turn anew: at once it grows to at most GROWTH times its
size, or to FEW_SENTENCES, and sentences beyond begin another turn. So the cost of a sentence is bounded."""
LAST_CALL = 0.9
"""Seconds before a turn's end after which no sentence joins it (DESIGN, section 6)."""
PREROLL = 1.0
"""Seconds in which emotions that are shown already rise before a stretch; they are not played."""


@dataclass(frozen=True, slots=True)
class LiveStretch:
    """A stretch that is played: values (frames, parameters), presets of emotion (frames, 4) and samples, from
    the face's frame `first` on.

    `sentences`: those that are said, possibly none; `spoken`: their text, and as `labels` that of each.
    `starts`: seconds at which each begins. `words`: seconds and first character of each. `is_full`: nothing
    joins it any more.
    """

    first: int
    values: Array
    emotion: Array
    samples: Samples
    sample_rate: int
    sentences: tuple[LiveSentence, ...] = ()
    spoken: str = ""
    labels: tuple[str, ...] = ()
    starts: tuple[float, ...] = ()
    words: tuple[tuple[float, int], ...] = ()
    feelings: Displays = ()
    is_full: bool = False

    @property
    def end(self) -> int:
        """The frame after the last."""
        return self.first + len(self.values)

    def sentence_at(self, seconds: float) -> str:
        """Return the sentence that is being said `seconds` after `first`."""
        return self.labels[max(bisect_right(self.starts, seconds) - 1, 0)] if self.labels else ""

    def unsaid_after(self, seconds: float) -> str:
        """Return the text from the first word that starts after `seconds` to the end."""
        later = [character for start, character in self.words if start > seconds]
        return self.spoken[later[0] :] if later else ""

    def join_deadline(self, fps: Fraction) -> int:
        """Return the last frame before which sentences may join."""
        return max(self.first, self.end - ceil(LAST_CALL * fps))


@dataclass(frozen=True, slots=True)
class TurnPlan:
    """The plan of a turn: `performer` makes it by the `settings`, and it begins at the frame `first`.

    `rate` is that of a turn without sound.
    """

    performer: TurnPerformer
    settings: Settings
    feelings: Displays
    first: int
    rate: int

    def performed(self, sentences: tuple[LiveSentence, ...]) -> LiveStretch:
        """Perform sentences together; raises RisoriusError if that cannot be done."""
        phrases = [sentence.voice.result() for sentence in sentences if sentence.voice is not None]
        if phrases:
            played = self.performer.voice(phrases, self.feelings, self.settings)
            texts = texts_of(phrases)
        else:
            texts = tuple(sentence.text for sentence in sentences)
            played = self.performer.text("".join(texts), self.feelings, self.settings)
        return stretch_of(played, sentences, texts, self.first, self.feelings, self.rate)

    def extended(self, before: tuple[LiveSentence, ...], new: tuple[LiveSentence, ...]) -> PerformedTurn:
        """Perform a turn with new sentences. If they cannot be spoken together, the others wait again."""
        try:
            return PerformedTurn(self.performed((*before, *new)), faults=_faults(new))
        except RisoriusError as error:
            if len(new) <= 1:
                return PerformedTurn(error=error)
        try:
            first = self.performed((*before, new[0]))
            return PerformedTurn(first, new[1:], _faults(new[:1]))
        except RisoriusError as error:
            return PerformedTurn(None, new[1:], error=error)

    def led_on(self, playing: LiveStretch, following: LiveSentence) -> PerformedTurn:
        """Perform a full turn as one that another follows at once, with a sentence that is not played.

        It ends where the sound of the next turn begins, so that the pause between them is like any other.
        """
        try:
            longer = self.performed((*playing.sentences, following))
        except RisoriusError:
            # The turn that says the sentence reports its fault.
            return PerformedTurn(replace(playing, is_full=True))
        if following.voice is None:
            border = longer.starts[len(playing.labels)] - self.settings.lead
        else:
            heard = following.voice.result().phrase.duration + self.settings.tail
            border = len(longer.samples) / longer.sample_rate - heard
        frames = round(border * self.settings.fps)
        samples = round(frames * longer.sample_rate / self.settings.fps)
        return PerformedTurn(
            replace(
                playing,
                values=longer.values[:frames],
                emotion=longer.emotion[:frames],
                samples=longer.samples[:samples],
                is_full=True,
            )
        )


@dataclass(frozen=True, slots=True)
class PerformedTurn:
    """The result of performing a turn: what it plays, None if its new sentences cannot be spoken, because of
    `error`; the sentences that wait again; and why phrases are heard less well than they might be.
    """

    stretch: LiveStretch | None = None
    rest: tuple[LiveSentence, ...] = ()
    faults: tuple[str, ...] = ()
    error: RisoriusError | None = None


def _faults(sentences: Sequence[LiveSentence]) -> tuple[str, ...]:
    phrases = [sentence.voice.result() for sentence in sentences if sentence.voice is not None]
    return tuple(phrase.fault for phrase in phrases if phrase.fault)


def room(size: int) -> int:
    """Return how many sentences may join a turn of this size at a time."""
    return min(max(FEW_SENTENCES - size, (GROWTH - 1) * size), MOST_SENTENCES - size)


def stretch_of(
    played: Played,
    sentences: tuple[LiveSentence, ...],
    texts: tuple[str, ...],
    first: int,
    feelings: Displays,
    rate: int,
) -> LiveStretch:
    """Return the stretch that plays from the frame `first` on; `rate` is that of a turn without sound.

    `texts`: those of the sentences, with the blanks between them.
    """
    starts, character = [], 0
    for text in filter(None, texts):
        first_words = [start for start, place in played.words if place >= character]
        starts.append(first_words[0] if first_words else 0.0)
        character += len(text)
    return LiveStretch(
        first,
        played.values,
        played.emotion,
        played.samples,
        played.sample_rate or rate,
        sentences,
        "".join(texts),
        tuple(text.strip() for text in texts if text),
        tuple(starts),
        played.words,
        feelings,
    )


def prerolled(settings: Settings) -> tuple[Settings, int]:
    """Return settings whose lead is longer, and the frames that are not played of it."""
    frames = ceil(PREROLL * settings.fps)
    return replace(settings, lead=settings.lead + float(frames / settings.fps)), frames
