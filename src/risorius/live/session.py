"""`Live`: say, feel, flush, interrupt and close from one side, frames from the other."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import AsyncIterator, Callable, Iterator
from dataclasses import dataclass, replace
from threading import Lock

import numpy as np

from ..api import speak
from ..core.arrays import Array
from ..core.audio import Samples
from ..core.frame_rate import parse_fps
from ..errors import InputError, ParameterError, UnreadError, unknown
from ..languages import language_of
from ..pipeline import with_profile
from ..rules.emotions import Display, Displays, emotion_names
from ..settings import Settings
from ..speech.engines.registry import is_voice_file, load_engine
from ..speech.engines.voices import find_voice
from ..take import Take
from .frame import LiveFrame
from .idle import IDLE_SECONDS, idle_take
from .pace import Pace
from .sentences import SentenceBuffer

# Seconds in which the face passes from one stretch to the next: an interrupted mouth shuts within .2 s.
SEAM = 0.15
# Seconds of silence behind a sentence; with the seam before the next they make its pause.
TAIL = 0.35
# Seconds without new text after which the last sentence counts as whole.
PATIENCE = 1.0
MOST_WAITING = 1_000
"""Sentences that may wait to be said."""
_SAMPLE_RATE = 22_050

PerformSentence = Callable[[str, Displays, Settings], Take]


@dataclass(frozen=True, slots=True)
class _Waiting:
    """A sentence that is to be said, and what was felt when it became whole."""

    text: str
    feelings: Displays


@dataclass(frozen=True, slots=True)
class _Stretch:
    """What is being played: values (frames, parameters) and samples from the frame `first` on."""

    first: int
    values: Array
    samples: Samples
    text: str = ""


def perform_sentence(text: str, feelings: Displays, settings: Settings) -> Take:
    """Perform one sentence as `speak` does."""
    return speak(text, text=True, source="live", emotion=feelings, settings=settings)


class Live:
    """A face that says what arrives in pieces, and lives in between.

    No clock takes part: `frames` yields the next frame when asked, and a frame depends on the text and on the
    frames at which it arrived, not on how it was cut. Text may come from another thread than the one that
    asks for frames. `perform` performs a sentence.
    """

    def __init__(
        self,
        settings: Settings | None = None,
        *,
        fps: float | None = None,
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
        self._buffer = SentenceBuffer(language_of(_language(chosen)))
        self._waiting: deque[_Waiting] = deque()
        self._feelings: dict[str, float] = {}
        self._lock = Lock()
        self._closed = self._interrupted = False
        self._next = self._units = self._last_text = 0
        self._sample_rate = _SAMPLE_RATE
        self._stretch: _Stretch | None = None
        self._last: Array | None = None
        self._seam_from: Array | None = None

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

    def interrupt(self) -> None:
        """Fall silent at once: what was not said is forgotten, and the mouth shuts within .2 s."""
        with self._lock:
            self._buffer.flush()
            self._waiting.clear()
            self._interrupted = True

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
        index, fps = self._next, self._settings.fps
        values = self._blended(stretch.values[index - stretch.first], index - stretch.first)
        edges = [round(k * self._sample_rate / fps) for k in (stretch.first, index, index + 1)]
        sound = np.zeros(edges[2] - edges[1], np.int16)
        heard = stretch.samples[edges[1] - edges[0] : edges[2] - edges[0]]
        sound[: len(heard)] = heard
        self._next, self._last = index + 1, values
        return LiveFrame(index, float(index / fps), values, sound, self._sample_rate, stretch.text)

    def _current(self) -> _Stretch | None:
        """Return the stretch that the next frame lies in; None at the end."""
        with self._lock:
            if self._buffer and self._next - self._last_text >= PATIENCE * self._settings.fps:
                self._queue(self._buffer.flush())
            playing = self._stretch
            if playing and (self._next - playing.first >= len(playing.values) or self._interrupted):
                playing = None
            self._interrupted = False
            is_idle = playing is None or not playing.text
            waiting = self._waiting.popleft() if is_idle and self._waiting else None
            feelings = self._felt()
            if waiting is None and is_idle and self._closed:
                return None
        if waiting is not None or playing is None:
            self._stretch = None
            self._stretch = playing = self._begin(waiting, feelings)
            self._seam_from = self._last
        return playing

    def _begin(self, waiting: _Waiting | None, feelings: Displays) -> _Stretch:
        # Every stretch has random numbers of its own.
        seed, self._units = self._settings.seed + self._units, self._units + 1
        if waiting is None:
            take = idle_take(IDLE_SECONDS, feelings, replace(self._idle_settings, seed=seed))
            return _Stretch(self._next, take.performance.values, np.zeros(0, np.int16))
        take = self._perform(waiting.text, waiting.feelings, replace(self._settings, seed=seed))
        samples = np.zeros(0, np.int16)
        if take.audio is not None:
            samples, self._sample_rate = take.audio.read(), take.audio.sample_rate
        return _Stretch(self._next, take.performance.values, samples, waiting.text)

    def _blended(self, values: Array, since: int) -> Array:
        """Return values so many frames after a stretch began: they leave those of the last one smoothly."""
        share = float((since + 1) / self._settings.fps) / SEAM
        if self._seam_from is None or share >= 1.0:
            return values
        weight = share * share * (3.0 - 2.0 * share)
        blended: Array = self._seam_from + weight * (values - self._seam_from)
        return blended

    def _queue(self, sentences: list[str]) -> None:
        self._waiting.extend(_Waiting(text, self._felt()) for text in sentences)

    def _felt(self) -> Displays:
        return tuple(Display(name, amount) for name, amount in self._feelings.items() if amount)


def _language(settings: Settings) -> str:
    """Return the code of the language that is spoken."""
    if settings.language is not None or settings.voice is None or is_voice_file(settings.voice):
        return settings.language or "en-us"
    return find_voice(settings.voice, None, load_engine()).language
