"""Words with given readings, in order, found in a stretch of sound; or words and phones by the sound alone.

pocketsphinx does it, in a process of its own (`aligner_worker`). Two passes align: the first finds which
reading of each word is said when, the second divides the words into phones. A little noise everywhere keeps
exact silence, which no model has heard, from ending the search early.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple, Self, TypeVar

import numpy as np

from ...core.arrays import Array
from ...core.speech.utterance import SILENCE
from ...errors import SpeechError
from ...machine.workers import Worker, WorkerError
from ..resampled import RATE

# The language of the model, and of its dictionary.
MODEL_LANGUAGE = "en-us"
# Seconds of the model's frames. A frame's features are those of the sound around its middle.
FRAME = 0.01
MIDDLE = FRAME / 2
PAD_SECONDS = 0.2
_NOISE = 10.0
# Seconds after which an answer is given up: to start with, and for each second of the sound. The slowest
# request, a transcript that does not fit, takes a tenth of the latter.
PATIENCE, PATIENCE_PER_SECOND = 60.0, 10.0

_TASK = f"{Path(__file__).with_name('aligner_worker.py')}:answer"

Reading = tuple[str, ...]
Readings = tuple[Reading, ...]
T = TypeVar("T")


class AlignmentError(Exception):
    """The words cannot be found in the sound."""


class AlignedPhone(NamedTuple):
    """A phone, or silence of word -1, in [start, end) seconds. `score`: mean log likelihood per frame."""

    symbol: str
    start: float
    end: float
    word: int
    score: float


class HeardSegment(NamedTuple):
    """A segment heard in [start, end) seconds: a word or a phone by `name`, or noise that is not `spoken`."""

    name: str
    start: float
    end: float
    spoken: bool


class Decoders:
    """The decoders of one recording, in processes of their own. Use as a context manager, which ends them.

    Earlier sound changes the results of a decoder: no two recordings share one. `follow_words` may be
    called in another thread than the others. Every method raises WorkerError if its process fails or does not
    answer in time.
    """

    def __init__(self) -> None:
        self._aligner, self._follower = _Process(), _Process()
        self._turns = _Turns((self._aligner, _Process()))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._turns.end()
        self._follower.end()

    def align_words(self, sound: Array, words: Sequence[Readings]) -> list[AlignedPhone]:
        """Return the phones and silences of `sound` (16 kHz), in which all `words` are said in order.

        They follow one another without gaps. Raises AlignmentError if the sound is too short for the words.
        """
        return _aligned(self._aligner, sound, words)

    def fit_words(self, sound: Array, words: Sequence[Readings]) -> list[AlignedPhone]:
        """Return what `align_words` does, in less time; AlignmentError for words that fit badly, too."""
        return _aligned(self._follower, sound, words, "fit")

    def align_in_turn(
        self, sound: Array, words: Sequence[Readings], *, last: bool
    ) -> Future[list[AlignedPhone]]:
        """Begin to align the next of several sounds, as `align_words` does, and return at once.

        Two are aligned at the same time. `last`: no other will follow.
        """
        return self._turns.align(sound, words, last)

    def follow_words(self, sound: Array, words: Sequence[Readings]) -> list[tuple[float, float]]:
        """Return the spans in seconds of as many of `words`, from the first on, as are said in `sound`."""
        found = _segments(self._follower.ask("follow", sound, words))
        return [(segment.start, segment.end) for segment in found if segment.spoken]

    def name_words(self, sound: Array) -> list[str]:
        """Return the words that a language model hears in `sound`."""
        return [
            segment.name for segment in _segments(self._aligner.ask("name_words", sound)) if segment.spoken
        ]

    def name_phones(self, sound: Array) -> list[HeardSegment]:
        """Decode `sound` with a free phone loop; return the phones and non-speech segments."""
        return _segments(self._aligner.ask("name_phones", sound))


class _Process:
    """An aligner's process, started when it is first needed."""

    def __init__(self) -> None:
        self._worker: Worker | None = None
        self._failed = False

    def ask(self, op: str, sound: Array, words: Sequence[Readings] = ()) -> dict[str, Any]:
        """Return the answer to a request; raise WorkerError if the worker fails, now or before."""
        if self._failed:
            raise WorkerError("has ended")
        if self._worker is None:
            _package()  # raises an error if it is not there
            self._worker = Worker()
        seconds = PATIENCE + PATIENCE_PER_SECOND * len(sound) / RATE
        request = {"op": op, "readings": words}
        try:
            answer: dict[str, Any] = self._worker.call(_TASK, request, _prepared(sound), seconds=seconds)
        except WorkerError:
            self._failed = True
            raise
        return answer

    def end(self) -> None:
        """End it."""
        if self._worker is not None:
            self._worker.close()


class _Turns:
    """Processes that align one sound after another in turn.

    Each hears the others' sounds, too, so that its decoder adapts as that of a single process would.
    """

    def __init__(self, processes: Sequence[_Process]) -> None:
        self._processes = processes
        self._threads = [ThreadPoolExecutor(1, "align") for _ in processes]
        self._count = 0

    def align(self, sound: Array, words: Sequence[Readings], last: bool) -> Future[list[AlignedPhone]]:
        """Begin to align the next sound in its process; unless it is the `last`, let the others hear it."""
        turn = self._count % len(self._processes)
        self._count += 1
        for number, (thread, process) in enumerate(zip(self._threads, self._processes, strict=True)):
            if number != turn and not last:
                thread.submit(process.ask, "hear", sound)
        return self._threads[turn].submit(_aligned, self._processes[turn], sound, words)

    def end(self) -> None:
        """End all processes, whatever they are doing."""
        for thread in self._threads:
            thread.shutdown(wait=False, cancel_futures=True)
        for process in self._processes:
            process.end()
        for thread in self._threads:
            thread.shutdown()
        # A thread may have been about to start one.
        for process in self._processes:
            process.end()


def _aligned(
    process: _Process, sound: Array, words: Sequence[Readings], op: str = "align"
) -> list[AlignedPhone]:
    answer = process.ask(op, sound, words)
    if sum(segment.spoken for segment in _segments(answer)) != len(words):
        raise AlignmentError
    return list(_phones(answer["words"], len(sound) / RATE))


def with_decoders(work: Callable[[Decoders], T]) -> T:
    """Return the result of `work` with one recording's decoders; if they die or fall silent, with new ones.

    Raises SpeechError if these do, too.
    """
    try:
        with Decoders() as decoders:
            return work(decoders)
    except WorkerError:
        try:
            with Decoders() as decoders:
                return work(decoders)
        except WorkerError as error:
            raise SpeechError(f"the aligner failed twice in a row; the second time it {error}") from error


def dictionary_path() -> Path:
    """Return the path of the pronunciation dictionary that comes with the model (CMUdict)."""
    return _package() / "pocketsphinx" / "model" / "en-us" / "cmudict-en-us.dict"


def _package() -> Path:
    """Return the folder that holds pocketsphinx. It is only located: the worker imports it."""
    spec = importlib.util.find_spec("pocketsphinx")
    if spec is None or spec.origin is None:
        raise SpeechError(
            "recordings need the package 'pocketsphinx', which is not installed (pip install pocketsphinx), "
            "or a TextGrid with words and phones (risorius speak x.TextGrid --audio x.wav)"
        )
    return Path(spec.origin).parent.parent


def _prepared(sound: Array) -> bytes:
    """Return the sound as the decoder takes it: with noise everywhere and PAD_SECONDS of it at both ends."""
    padded = np.pad(sound, round(PAD_SECONDS * RATE))
    padded += np.random.default_rng(0).normal(0.0, _NOISE, len(padded))
    return np.clip(np.round(padded), -32_768, 32_767).astype("<i2").tobytes()


def _segments(answer: dict[str, Any]) -> list[HeardSegment]:
    return [
        HeardSegment(name, start * FRAME - PAD_SECONDS, (last + 1) * FRAME - PAD_SECONDS, _is_spoken(name))
        for name, start, last in answer["segments"]
    ]


def _is_spoken(name: str) -> bool:
    return not name.startswith(("<", "[", "+", "("))


def _phones(words: Sequence[Any], duration: float) -> Iterator[AlignedPhone]:
    """Yield the aligned phones, cut to [0, duration]: a phone in the padding has no length left."""
    index = -1
    for word, phones in words:
        spoken = _is_spoken(word)
        index += spoken
        for name, first, frames, score in phones:
            start = first * FRAME + MIDDLE - PAD_SECONDS
            end = (first + frames) * FRAME + MIDDLE - PAD_SECONDS
            start, end = min(max(start, 0.0), duration), min(max(end, 0.0), duration)
            if spoken or start < end:
                symbol = name if spoken else SILENCE
                yield AlignedPhone(symbol, start, end, index if spoken else -1, score / frames)
