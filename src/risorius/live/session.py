"""`Live`: say, feel, flush, interrupt and close from one side, frames from the other."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import AsyncIterator, Iterable, Iterator
from dataclasses import replace
from fractions import Fraction
from threading import Lock
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from ..api import checked
from ..channels.eye_head import Angles
from ..channels.gaze import LISTENER
from ..core.arrays import Array
from ..core.frame_rate import parse_fps
from ..errors import InputError, ParameterError, UnusedSettingError, check_number, unknown
from ..rules.emotions import Displays, emotion_names
from ..settings import Settings
from ..take import with_profile
from .crossfade import CROSSFADE, CrossFade
from .frame import LiveFrame
from .idle import IDLE_SECONDS, idle_take
from .listening import PauseListener, nod_pitch, nodded
from .looking import Looking, direction_of
from .pace import Pace
from .performer import (
    LocalPerformer,
    PerformSentence,
    TurnPerformer,
    hear_later,
    language_spoken,
    perform_sentence,
    played,
)
from .process_performer import process_performer
from .sentence_queue import LiveSentence, SentenceQueue
from .turn import (
    FEW_SENTENCES,
    FIRST_CHARACTERS,
    MOST_SENTENCES,
    TAIL,
    LiveStretch,
    PerformedTurn,
    TurnPlan,
    prerolled,
    room,
    stretch_of,
)
from .turn_extension import TurnExtension, join_later, lead_on_later

if TYPE_CHECKING:
    from .weights import LiveWeights

# Seconds for which the face looks at who interrupts it.
TURNED = 2.0
# Seconds without new text after which the last sentence counts as whole.
PATIENCE = 1.0
_SAMPLE_RATE = 22_050


class Live:
    """A face that speaks text and sound as they arrive in pieces, and lives in between.

    No clock takes part unless frames are paced: `frames` yields the next frame when asked, and a frame
    depends on the text and on the frames at which it arrived, not on how it was cut. Text may come from
    another thread than the one that asks for frames. Sentences that are whole .9 s before the end of what is
    said are performed with it, as `speak` does: in another thread, for paced frames in another process.
    `arkit`: each frame has the weights of ARKit's shapes; raises HeadError if the head has none.
    """

    def __init__(
        self,
        settings: Settings | None = None,
        *,
        fps: float | None = None,
        arkit: bool = False,
        perform: PerformSentence = perform_sentence,
    ) -> None:
        chosen = checked(settings)
        if fps is not None:
            chosen = replace(chosen, fps=parse_fps(fps))
        changed = [name for name in ("lead", "tail") if getattr(chosen, name) != getattr(Settings(), name)]
        if changed:
            raise UnusedSettingError(changed, "a live face sets its own pauses; leave them at their defaults")
        self._settings = replace(chosen, lead=CROSSFADE, tail=TAIL)
        self._idle_settings = with_profile(self._settings)
        self._performer: TurnPerformer = LocalPerformer(perform)
        self._weights = _weights(self._settings) if arkit else None
        language = language_spoken(chosen)
        self._waiting = SentenceQueue(
            language, lambda phrase, before: hear_later(self._performer, phrase, language, before)
        )
        # Why phrases are heard less well than they might be.
        self._faults: deque[str] = deque()
        self._lock = Lock()
        self._closed = self._interrupted = False
        # Whether frames wait for what is being heard.
        self._waits = True
        self._next = self._turns = self._idles = self._last_text = 0
        self._sample_rate = _SAMPLE_RATE
        self._stretch: LiveStretch | None = None
        # How the turn that plays is performed, who joins it, and who begins one.
        self._plan: TurnPlan | None = None
        self._joining: TurnExtension | None = None
        self._beginning: tuple[LiveSentence, ...] = ()
        self._last: Array | None = None
        self._crossfade = CrossFade(self._settings.fps)
        self._listener = PauseListener()
        self._nod_from: int | None = None
        self._looking = Looking(self._settings.fps)

    @property
    def fps(self) -> Fraction:
        """Frames a second."""
        return self._settings.fps

    @property
    def waiting(self) -> int:
        """Sentences that wait to be said."""
        return len(self._waiting) + len(self._performing())

    def say(
        self,
        text: str = "",
        *,
        audio: ArrayLike | bytes | None = None,
        rate: int | None = None,
        encoding: str = "pcm_s16le",
        words: Iterable[tuple[str, float, float]] = (),
    ) -> None:
        """Add text, cut anywhere: a sentence is said once the next has begun, or nothing came for a second.

        With `audio` a piece of a voice that was made elsewhere is played instead: samples (int16, or -1..1),
        or bytes in an encoding of `core.pcm`, at `rate` Hz. `text` is what it says, so far as it is known,
        and `words` the words with their start and end in seconds since the sound began, or since `flush`.
        With the words' times a phrase begins when the next one is known to come; with its text alone when
        `flush` ends it; with neither, in a pause or after 6 s. Raises InputError after `close`, if too much
        waits, or for sound and words that cannot be used; then nothing is added.
        """
        if not isinstance(text, str):
            raise InputError(f"{type(text).__name__} cannot be said; expected a text")
        with self._lock:
            if self._closed:
                raise InputError("nothing can be said after close")
            if audio is not None:
                if rate is None:
                    raise InputError("sound without its rate; expected Hz")
                self._waiting.add_voice(audio, rate, encoding, text, words)
            elif rate is not None or words:
                raise InputError("a rate or words without sound; expected audio as well")
            else:
                self._waiting.add_text(text)
            self._last_text = self._next

    def flush(self) -> None:
        """End the sentence, or the phrase of a voice, that waits for its end."""
        with self._lock:
            self._waiting.end()

    def look(self, target: str | Angles | None) -> None:
        """Look in a direction until told otherwise: a name (`listener`, `left`, `up` …), or pitch and yaw in
        degrees, up and to the face's own left; None gives the looks back to the face.

        Raises InputError for an unknown name, ParameterError for angles that are out of range.
        """
        self._looking.look(None if target is None else direction_of(target))

    def feel(self, emotion: str, intensity: float) -> None:
        """Show an emotion at 0..1, from the next sentence that becomes whole on, and in between.

        Raises RisoriusError for an unknown emotion or an intensity out of range.
        """
        names = emotion_names()
        if not isinstance(emotion, str):
            raise InputError(f"{emotion!r} is not the name of an emotion")
        check_number(emotion, intensity)
        if emotion.lower() not in names:
            raise InputError(unknown("emotion", emotion, names))
        if not 0 <= intensity <= 1:
            raise ParameterError(f"{emotion} = {intensity} is out of range; expected 0 to 1")
        with self._lock:
            self._waiting.feel(names[emotion.lower()], intensity)

    def listen(self, samples: ArrayLike, rate: int) -> None:
        """Hear a piece of the other's speech; the face nods at its pauses unless it speaks itself.

        `samples`: one channel, int16 or -1..1. Raises InputError for other sound, which is not heard.
        """
        with self._lock:
            if self._listener.hear(samples, rate) and (self._stretch is None or not self._stretch.sentences):
                self._nod_from = self._next

    def interrupt(self) -> str:
        """Fall silent at once, with the mouth shut within .2 s, and look at the listener; return what was not
        said.

        It begins at the first word that was not heard yet, and is forgotten.
        """
        with self._lock:
            unsaid = "".join(sentence.said() for sentence in self._performing()) + self._waiting.clear()
            self._joining, self._beginning = None, ()
            playing = self._stretch
            if playing is not None and not self._interrupted:
                since = float((self._next - playing.first) / self._settings.fps)
                unsaid = playing.unsaid_after(since) + unsaid
            self._faults.clear()
            self._interrupted = True
            if not self._looking.is_told:
                self._looking.look(LISTENER, TURNED)
            return unsaid.strip()

    def close(self) -> None:
        """Say all text that has arrived; then `frames` ends."""
        with self._lock:
            self._waiting.end()
            self._closed = True

    def frames(self, *, paced: bool = False, waits: bool = True) -> Iterator[LiveFrame]:
        """Yield frame after frame, idle ones too, until `close` and the end of the last sentence.

        With `paced` each is yielded when its time has come, counted from the first. Unless it `waits`, and
        if it is paced, the face lives on while the words of a voice are found, and the clock takes part. An
        error in a sentence (RisoriusError) is raised once; `frames`, called again, goes on after it.
        """
        self._set_waiting(waits and not paced)
        return self._frames(paced=paced)

    def _frames(self, *, paced: bool) -> Iterator[LiveFrame]:
        pace = Pace(self._settings.fps, time.monotonic)
        while (frame := self._frame()) is not None:
            if paced and (wait := pace.wait(frame.index)):
                time.sleep(wait)
            yield frame

    def aframes(self) -> AsyncIterator[LiveFrame]:
        """Yield the frames of `frames`, paced; each is made in another thread meanwhile."""
        self._set_waiting(False)
        return self._aframes()

    async def _aframes(self) -> AsyncIterator[LiveFrame]:
        pace = Pace(self._settings.fps, time.monotonic)
        while (frame := await asyncio.to_thread(self._frame)) is not None:
            if wait := pace.wait(frame.index):
                await asyncio.sleep(wait)
            yield frame

    def _set_waiting(self, waits: bool) -> None:
        """Let frames wait for speech that is being heard, or come in time: then a process beside performs."""
        self._waits = waits
        if self._performer.may_move and not waits:
            self._performer = process_performer()

    def _frame(self) -> LiveFrame | None:
        stretch = self._current()
        if self._faults:
            raise InputError(self._faults.popleft())
        if stretch is None:
            return None
        index, fps, rate = self._next, self._settings.fps, stretch.sample_rate
        values = self._crossfade.blended(stretch.values[index - stretch.first], index)
        edges = [round(k * rate / fps) for k in (stretch.first, index, index + 1)]
        sound = np.zeros(edges[2] - edges[1], np.int16)
        heard = stretch.samples[edges[1] - edges[0] : edges[2] - edges[0]]
        sound[: len(heard)] = heard
        self._next, self._last = index + 1, values
        if self._nod_from is not None and (nod := nod_pitch(float((index - self._nod_from) / fps))):
            values = nodded(values, nod)
        values = self._looking.shown(values, index)
        text = stretch.sentence_at(float((index - stretch.first) / fps))
        speaking = bool(stretch.sentences)
        emotion = self._crossfade.approached(stretch.emotion[index - stretch.first])
        frame = LiveFrame(index, float(index / fps), values, sound, rate, text, speaking, emotion=emotion)
        return frame if self._weights is None else self._weights.added(frame)

    def _current(self) -> LiveStretch | None:
        """Return the stretch that the next frame lies in; None at the end."""
        with self._lock:
            waits = self._next - self._last_text
            if self._waiting.is_unfinished and waits >= PATIENCE * self._settings.fps:
                self._waiting.end()
            playing = self._stretch
            if playing and (self._next >= playing.end or self._interrupted):
                playing = None
            self._interrupted = False
            if playing is not None and playing.sentences:
                if not self._joins(playing):
                    return playing
                sentences: tuple[LiveSentence, ...] = ()
                feelings = playing.feelings
            else:
                few = FEW_SENTENCES, FIRST_CHARACTERS
                sentences = self._beginning = self._waiting.take(None, *few, heard=not self._waits)
                feelings = sentences[0].feelings if sentences else self._waiting.felt
                if not sentences and self._closed and not len(self._waiting):
                    return None
        if self._joining is not None:
            self._join(self._joining)
        elif sentences or playing is None:
            self._begin(sentences, feelings)
        return self._stretch

    def _performing(self) -> tuple[LiveSentence, ...]:
        """Return the sentences that no stretch has yet and that wait no more."""
        return self._beginning if self._joining is None else self._joining.sentences

    def _joins(self, playing: LiveStretch) -> bool:
        """Have sentences that came in time join the turn that plays; tell whether they are due."""
        plan = self._plan
        if plan is not None and self._may_join(playing, plan):
            most = room(len(playing.sentences))
            new = self._waiting.take(playing.sentences[0], most, heard=not self._waits)
            following = self._waiting.next_of(playing.sentences[0])
            if new:
                self._joining = join_later(playing, new, plan, self._next)
            elif len(playing.sentences) >= MOST_SENTENCES and following is not None:
                self._joining = lead_on_later(playing, following, plan, self._next)
        joining = self._joining
        if joining is None or self._next < joining.at:
            return False
        # Frames that must come in time go on without it, unless a sentence ends there.
        return self._waits or joining.turn.done() or self._next >= playing.join_deadline(self._settings.fps)

    def _may_join(self, playing: LiveStretch, plan: TurnPlan) -> bool:
        """Tell whether there is time to join the turn that plays, and nothing joins it yet."""
        in_time = self._next <= playing.join_deadline(plan.settings.fps)
        return in_time and not playing.is_full and self._joining is None and not self._beginning

    def _join(self, joining: TurnExtension) -> None:
        """Continue with the extended turn; if its new sentences fail, tell why and keep the old turn."""
        performed = joining.turn.result()
        playing = self._stretch
        with self._lock:
            if self._joining is not joining or playing is None:
                # Interrupted meanwhile.
                return
            self._joining = None
            if performed.stretch is not None:
                self._stretch = performed.stretch
                assert self._last is not None
                coming = performed.stretch.values[self._next - 1 - performed.stretch.first :]
                self._crossfade.follow(self._last, coming, self._next)
        self._told(performed)

    def _told(self, performed: PerformedTurn) -> None:
        """Put back sentences that could not be said together, and report the faults of those that were."""
        with self._lock:
            self._waiting.put_back(performed.rest)
        self._faults += performed.faults
        if performed.error is not None:
            raise performed.error

    def _begin(self, sentences: tuple[LiveSentence, ...], feelings: Displays) -> None:
        """Begin a turn, or an idle stretch; raises RisoriusError for a sentence that cannot be spoken."""
        before, self._stretch = self._stretch, None
        if sentences:
            # The first turn has the random numbers of `speak`, every other one others.
            chosen = replace(self._settings, seed=self._settings.seed + self._turns)
            chosen, first = self._after(before, chosen, feelings)
            self._plan = TurnPlan(self._performer, chosen, feelings, first, self._sample_rate)
            performed = self._plan.extended((), sentences)
            with self._lock:
                if self._interrupted:
                    # While it was performed: nothing of it is said.
                    performed = replace(performed, rest=())
                self._stretch, self._beginning = performed.stretch, ()
            self._told(performed)
            assert performed.stretch is not None
            self._turns, self._sample_rate = self._turns + 1, performed.stretch.sample_rate
        else:
            self._stretch = self._begin_idle(before, feelings)
        self._crossfade.start(self._last, self._next)

    def _begin_idle(self, before: LiveStretch | None, feelings: Displays) -> LiveStretch:
        chosen = replace(self._idle_settings, seed=self._settings.seed + self._idles)
        chosen, first = self._after(before, chosen, feelings)
        self._idles += 1
        take = idle_take(IDLE_SECONDS + float((self._next - first) / chosen.fps), feelings, chosen)
        return stretch_of(played(take), (), (), first, feelings, self._sample_rate)

    def _after(
        self, before: LiveStretch | None, chosen: Settings, feelings: Displays
    ) -> tuple[Settings, int]:
        """Return settings and first frame of a stretch that goes on with the emotions of the one before."""
        if not feelings or before is None or before.feelings != feelings:
            return chosen, self._next
        chosen, dropped = prerolled(chosen)
        return chosen, self._next - dropped


def _weights(settings: Settings) -> LiveWeights:
    """Return the fit of weights, which loads the face only if they are asked for."""
    from .weights import LiveWeights

    return LiveWeights(settings)
