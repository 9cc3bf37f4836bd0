"""`Live`: say, feel, flush, interrupt and close from one side, frames from the other."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import AsyncIterator, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..api import speak
from ..core.arrays import Array
from ..core.frame_rate import parse_fps
from ..core.parameters import INDEX
from ..errors import InputError, ParameterError, RisoriusError, UnreadError, unknown
from ..languages import language_of
from ..pipeline import with_profile
from ..rules.emotions import Display, Displays, emotion_names
from ..settings import Settings
from ..speech.engines.registry import is_voice_file, load_engine
from ..speech.engines.voices import find_voice
from ..take import Take
from .frame import LiveFrame
from .idle import IDLE_SECONDS, idle_take
from .listening import PauseListener, nod_pitch
from .pace import Pace
from .sentences import SentenceBuffer
from .turn import MOST_SENTENCES, LiveStretch, PerformSentence, prerolled, stretch_of

if TYPE_CHECKING:
    from .weights import LiveWeights

# Seconds in which the face passes from one stretch to the next: an interrupted mouth shuts within .2 s.
SEAM = 0.15
# Seconds of silence behind a sentence; with the seam before the next they make its pause.
TAIL = 0.35
# Seconds without new text after which the last sentence counts as whole.
PATIENCE = 1.0
MOST_WAITING = 1_000
"""Sentences that may wait to be said."""
_SAMPLE_RATE = 22_050
_HEAD_PITCH = INDEX["head_pitch"]


@dataclass(frozen=True, slots=True)
class _Waiting:
    """A sentence that is to be said, and what was felt when it became whole."""

    text: str
    feelings: Displays


def perform_sentence(text: str, feelings: Displays, settings: Settings) -> Take:
    """Perform sentences as `speak` does."""
    return speak(text, text=True, source="live", emotion=feelings, settings=settings)


class Live:
    """A face that says what arrives in pieces, and lives in between.

    No clock takes part: `frames` yields the next frame when asked, and a frame depends on the text and on the
    frames at which it arrived, not on how it was cut. Text may come from another thread than the one that
    asks for frames. Sentences that are there when a turn begins, and those that come .9 s before it ends, are
    performed together as `speak` performs their text. `perform` performs them. With `arkit` each frame has
    the weights of ARKit's shapes as well; raises HeadError if the head has none.
    """

    def __init__(
        self,
        settings: Settings | None = None,
        *,
        fps: float | None = None,
        arkit: bool = False,
        perform: PerformSentence = perform_sentence,
    ) -> None:
        chosen = settings or Settings()
        if fps is not None:
            chosen = replace(chosen, fps=parse_fps(fps))
        changed = [name for name in ("lead", "tail") if getattr(chosen, name) != getattr(Settings(), name)]
        if changed:
            raise UnreadError(changed, "a live face has pauses of its own; expected none")
        self._settings = replace(chosen, lead=SEAM, tail=TAIL)
        self._idle_settings = with_profile(self._settings)
        self._perform = perform
        self._weights = _weights(self._settings) if arkit else None
        self._buffer = SentenceBuffer(language_of(_language(chosen)))
        self._waiting: deque[_Waiting] = deque()
        self._feelings: dict[str, float] = {}
        self._lock = Lock()
        self._closed = self._interrupted = False
        self._next = self._turns = self._idles = self._last_text = 0
        self._sample_rate = _SAMPLE_RATE
        self._stretch: LiveStretch | None = None
        # Those of the turn that plays.
        self._turn_settings = self._settings
        self._last: Array | None = None
        self._seam_from: Array | None = None
        self._seam_at = 0
        self._listener = PauseListener()
        self._nod_from: int | None = None

    @property
    def fps(self) -> Fraction:
        """Frames a second."""
        return self._settings.fps

    def say(self, text: str) -> None:
        """Add text, cut anywhere: a sentence is said once the next has begun, or nothing came for a second.

        Raises InputError after `close`, or if too much text waits.
        """
        with self._lock:
            if self._closed:
                raise InputError("nothing can be said after close")
            if len(self._waiting) >= MOST_WAITING:
                raise InputError(f"{MOST_WAITING:,} sentences wait already; expected text as it is said")
            self._last_text = self._next
            self._queue(self._buffer.add(text))

    def flush(self) -> None:
        """End the sentence that waits for its end."""
        with self._lock:
            self._queue(self._buffer.flush())

    def feel(self, emotion: str, intensity: float) -> None:
        """Show an emotion at 0..1, from the next sentence that becomes whole on, and in between.

        Raises RisoriusError for an unknown emotion or an intensity out of range.
        """
        names = emotion_names()
        if emotion.lower() not in names:
            raise InputError(unknown("emotion", emotion, names))
        if not 0 <= intensity <= 1:
            raise ParameterError(f"{emotion} = {intensity} is out of range; expected 0 to 1")
        with self._lock:
            self._feelings[names[emotion.lower()]] = intensity

    def listen(self, samples: ArrayLike, rate: int) -> None:
        """Hear a piece of what the other says; the face nods at its pauses if it says nothing itself.

        `samples`: one channel, int16 or -1..1. Raises InputError for other sound, which is not heard.
        """
        with self._lock:
            if self._listener.hear(samples, rate) and (self._stretch is None or not self._stretch.spoken):
                self._nod_from = self._next

    def interrupt(self) -> str:
        """Fall silent at once, with the mouth shut within .2 s; return the text that was not said.

        It begins at the first word that was not heard yet, and is forgotten.
        """
        with self._lock:
            waiting = [sentence.text for sentence in self._waiting]
            unsaid = [*waiting, *self._buffer.flush()]
            playing = self._stretch
            if playing is not None and not self._interrupted:
                since = float((self._next - playing.first) / self._settings.fps)
                unsaid = [playing.unsaid_after(since), *unsaid]
            self._waiting.clear()
            self._interrupted = True
            return "".join(unsaid).strip()

    def close(self) -> None:
        """Say what has arrived; then `frames` ends."""
        self.flush()
        with self._lock:
            self._closed = True

    def frames(self, *, paced: bool = False) -> Iterator[LiveFrame]:
        """Yield frame after frame, idle ones too, until `close` and the end of what is being said.

        With `paced` each is yielded when its time has come, counted from the first. An error in a sentence
        (RisoriusError) is raised once; `frames`, called again, goes on after it.
        """
        pace = Pace(self._settings.fps, time.monotonic)
        while (frame := self._frame()) is not None:
            if paced and (wait := pace.wait(frame.index)):
                time.sleep(wait)
            yield frame

    async def aframes(self) -> AsyncIterator[LiveFrame]:
        """Yield what `frames` does, paced; sentences are performed in another thread meanwhile."""
        pace = Pace(self._settings.fps, time.monotonic)
        while (frame := await asyncio.to_thread(self._frame)) is not None:
            if wait := pace.wait(frame.index):
                await asyncio.sleep(wait)
            yield frame

    def _frame(self) -> LiveFrame | None:
        stretch = self._current()
        if stretch is None:
            return None
        index, fps, rate = self._next, self._settings.fps, stretch.sample_rate
        values = self._blended(stretch.values[index - stretch.first])
        edges = [round(k * rate / fps) for k in (stretch.first, index, index + 1)]
        sound = np.zeros(edges[2] - edges[1], np.int16)
        heard = stretch.samples[edges[1] - edges[0] : edges[2] - edges[0]]
        sound[: len(heard)] = heard
        self._next, self._last = index + 1, values
        if self._nod_from is not None:
            values = values.copy()
            values[_HEAD_PITCH] += nod_pitch(float((index - self._nod_from) / fps))
        text = stretch.sentence_at(float((index - stretch.first) / fps))
        frame = LiveFrame(index, float(index / fps), values, sound, rate, text)
        return frame if self._weights is None else self._weights.added(frame)

    def _current(self) -> LiveStretch | None:
        """Return the stretch that the next frame lies in; None at the end."""
        with self._lock:
            if self._buffer and self._next - self._last_text >= PATIENCE * self._settings.fps:
                self._queue(self._buffer.flush())
            playing = self._stretch
            if playing and (self._next >= playing.end or self._interrupted):
                playing = None
            self._interrupted = False
            is_idle = playing is None or not playing.spoken
            joined = None if is_idle else playing
            if joined and self._next != joined.last_call(self._settings.fps):
                return joined
            sentences, feelings = self._take(joined)
            if is_idle and not sentences and self._closed:
                return None
        if sentences or playing is None:
            self._stretch = self._begun(joined, sentences, feelings)
            rest = None if self._last is None else self._last[None]
            self._seam_from = rest if joined is None else joined.values[self._next - joined.first :]
            self._seam_at = self._next
        return self._stretch

    def _take(self, joined: LiveStretch | None) -> tuple[tuple[str, ...], Displays]:
        """Take the sentences that are said next, in a new turn or in one that plays, and what is felt."""
        taken: list[str] = []
        room = MOST_SENTENCES - (len(joined.sentences) if joined else 0)
        first = self._waiting[0].feelings if self._waiting else self._felt()
        feelings = joined.feelings if joined else first
        while self._waiting and len(taken) < room and self._waiting[0].feelings == feelings:
            taken.append(self._waiting.popleft().text)
        return tuple(taken), feelings

    def _begun(
        self, joined: LiveStretch | None, sentences: tuple[str, ...], feelings: Displays
    ) -> LiveStretch:
        """Return what plays now. If sentences cannot be spoken together, the others wait for the first."""
        before = self._stretch
        if not sentences:
            return self._begin_idle(before, feelings)
        # If nothing can be spoken, the stretch before is over; a turn goes on without those that join.
        self._stretch = joined
        try:
            return self._begin_turn(joined, before, sentences, feelings)
        except RisoriusError:
            if len(sentences) == 1:
                raise
        with self._lock:
            self._waiting.extendleft(_Waiting(text, feelings) for text in reversed(sentences[1:]))
        return self._begin_turn(joined, before, sentences[:1], feelings)

    def _begin_turn(
        self,
        joined: LiveStretch | None,
        before: LiveStretch | None,
        sentences: tuple[str, ...],
        feelings: Displays,
    ) -> LiveStretch:
        if joined is not None:
            sentences, chosen, first = (*joined.sentences, *sentences), self._turn_settings, joined.first
        else:
            # The first turn has the random numbers of `speak`, every other one others.
            chosen = replace(self._settings, seed=self._settings.seed + self._turns)
            chosen, first = self._after(before, chosen, feelings)
        take = self._perform("".join(sentences), feelings, chosen)
        self._turn_settings, self._turns = chosen, self._turns + (joined is None)
        stretch = stretch_of(take, sentences, first, feelings, self._sample_rate)
        self._sample_rate = stretch.sample_rate
        return stretch

    def _begin_idle(self, before: LiveStretch | None, feelings: Displays) -> LiveStretch:
        chosen = replace(self._idle_settings, seed=self._settings.seed + self._idles)
        chosen, first = self._after(before, chosen, feelings)
        self._idles += 1
        take = idle_take(IDLE_SECONDS + float((self._next - first) / chosen.fps), feelings, chosen)
        return stretch_of(take, (), first, feelings, self._sample_rate)

    def _after(
        self, before: LiveStretch | None, chosen: Settings, feelings: Displays
    ) -> tuple[Settings, int]:
        """Return settings and first frame of a stretch that goes on with what is felt in the one before."""
        if not feelings or before is None or before.feelings != feelings:
            return chosen, self._next
        chosen, dropped = prerolled(chosen)
        return chosen, self._next - dropped

    def _blended(self, values: Array) -> Array:
        """Return the next frame's values: at a seam they smoothly leave what would have been shown."""
        since = self._next - self._seam_at
        share = float((since + 1) / self._settings.fps) / SEAM
        if self._seam_from is None or share >= 1.0:
            return values
        weight = share * share * (3.0 - 2.0 * share)
        before = self._seam_from[min(since, len(self._seam_from) - 1)]
        blended: Array = before + weight * (values - before)
        return blended

    def _queue(self, sentences: list[str]) -> None:
        self._waiting.extend(_Waiting(text, self._felt()) for text in sentences)

    def _felt(self) -> Displays:
        return tuple(Display(name, amount) for name, amount in self._feelings.items() if amount)


def _weights(settings: Settings) -> LiveWeights:
    """Return what fits weights, which loads the face only where they are asked for."""
    from .weights import LiveWeights

    return LiveWeights(settings)


def _language(settings: Settings) -> str:
    """Return the code of the language that is spoken."""
    if settings.language is not None or settings.voice is None or is_voice_file(settings.voice):
        return settings.language or "en-us"
    return find_voice(settings.voice, None, load_engine()).language
