"""Performing in processes beside this one, so that no frame waits for it.

To perform is Python's work, which holds up all other threads of a process again and again: ten faces whose
sentences were performed beside their frames fell seconds behind.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import threading
from collections.abc import Callable, Sequence
from typing import Any, TypeVar
from weakref import WeakSet

from ..machine.workers import Worker, WorkerError
from ..rules.emotions import Displays
from ..settings import Settings
from ..speech.engines.registry import is_voice_file
from .hearing import HeardPhrase
from .performer import LocalPerformer, Played, TurnPerformer
from .voice import VoicedPhrase

_TASKS = "risorius.live.worker"

# Faces that share a process before another is started, up to one for each processor; threads that may wait.
_FACES, _WAITING = 4, 32

Answered = TypeVar("Answered")


class LostError(Exception):
    """The process has ended, or does not answer."""


class PerformerWorker:
    """A process that performs one request after the other; it loads what it needs while others perform."""

    def __init__(self) -> None:
        self._worker = Worker(threads=1)
        self._worker.send(f"{_TASKS}:warm")
        self._lock = threading.Lock()
        self._ready = False
        atexit.register(self.close)

    @property
    def is_lost(self) -> bool:
        """Whether it has ended."""
        return self._worker.is_closed

    def ask(self, task: str, *arguments: object) -> Any:
        """Return the answer to a request; raise RisoriusError if that is the answer, LostError if there is
        none, or if it is still loading.
        """
        with self._lock:
            try:
                if not self._is_ready():
                    raise LostError
                return self._worker.call(f"{_TASKS}:perform", task, *arguments)
            except WorkerError:
                self.close()
                raise LostError from None

    def _is_ready(self) -> bool:
        if not self._ready and self._worker.has_come():
            self._worker.answer()
            self._ready = True
        return self._ready

    def close(self) -> None:
        """End it."""
        atexit.unregister(self.close)
        self._worker.close()


class ProcessPerformer:
    """Performs in a process; here while that is loading, if it is lost, and with the voice of a file, which
    may take its time.
    """

    def __init__(self, process: PerformerWorker) -> None:
        self.process, self._here = process, LocalPerformer()

    @property
    def threads(self) -> int:
        """Many: all but one wait."""
        return _WAITING

    @property
    def may_move(self) -> bool:
        """It has moved."""
        return False

    def text(self, text: str, feelings: Displays, settings: Settings) -> Played:
        """Perform a text."""
        if settings.voice is not None and is_voice_file(settings.voice):
            return self._here.text(text, feelings, settings)
        return self._answer(self._here.text, text, feelings, settings)

    def voice(self, phrases: Sequence[HeardPhrase], feelings: Displays, settings: Settings) -> Played:
        """Perform phrases of a voice."""
        return self._answer(self._here.voice, phrases, feelings, settings)

    def hear(self, phrase: VoicedPhrase, language: str) -> HeardPhrase:
        """Return what a phrase says when."""
        return self._answer(self._here.hear, phrase, language)

    def _answer(self, task: Callable[..., Answered], *arguments: object) -> Answered:
        try:
            answer: Answered = self.process.ask(task.__name__, *arguments)
        except LostError:
            return task(*arguments)
        return answer


class Processes:
    """The processes, and who performs in each."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._users: list[tuple[PerformerWorker, WeakSet[ProcessPerformer]]] = []

    def performer(self) -> TurnPerformer:
        """Return a performer in the process with the fewest faces; a performer here if there can be none."""
        with self._lock:
            self._grow()
            if not self._users:
                return LocalPerformer()
            process, users = min(self._users, key=lambda entry: len(entry[1]))
            performer = ProcessPerformer(process)
            users.add(performer)
            return performer

    def warm(self) -> None:
        """Start the process of the next face, unless there is one with room."""
        with self._lock:
            self._grow()

    def _grow(self) -> None:
        """Start a process if the others have no room and there may be one more."""
        self._users = [(process, users) for process, users in self._users if not process.is_lost]
        fewest = min((len(users) for _, users in self._users), default=_FACES)
        if fewest >= _FACES and len(self._users) < (os.cpu_count() or 1):
            with contextlib.suppress(WorkerError):
                self._users.append((PerformerWorker(), WeakSet()))


shared_processes = Processes()


def warm_processes() -> None:
    """Start the process that performs for the next face: it loads for a second or more."""
    shared_processes.warm()


def process_performer() -> TurnPerformer:
    """Return a performer in a process that several faces share; it is started if there is none."""
    return shared_processes.performer()
