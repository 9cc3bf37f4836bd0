"""Speak in a process beside this one, which meanwhile loads what draws.

To speak and plan takes nearly as long as to load the solver, the renderer and their kernels, and each is work
for one core. This is also the program of that process, `python -m risorius.speaking DESCRIPTOR`: it performs
what comes through a socket, once.
"""

from __future__ import annotations

import contextlib
import signal
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from multiprocessing.connection import Connection
from subprocess import DEVNULL
from typing import TYPE_CHECKING, Any

from .core.garbage import collect_no_more, collect_seldom
from .core.processes import LOOK, SilentError, Watch, end_connected, processors, start_connected
from .errors import RisoriusError, warn, warnings_to

if TYPE_CHECKING:
    from .core.progress import Progress
    from .settings import Settings
    from .take import HeadCache, Take

_PROGRAM = "risorius.speaking"
_TOLD, _WARNED, _FAILED, _DONE = "told", "warned", "failed", "done"
"""What an answer is: an argument list of `progress`, a warning, a RisoriusError, or the take."""


class LostSpeakerError(Exception):
    """The process has ended without a take, or stands still."""


def speak_and_prepare(arguments: Mapping[str, Any], settings: Settings, progress: Progress) -> Take:
    """Return `api.speak` of some arguments, ready to draw the pictures that `settings` want.

    If no processor is free for it, if it cannot be started, or is lost, this process speaks. Raises as
    `api.speak`.
    """
    if processors() < 2:
        return _speak_here(arguments, settings, progress)
    try:
        speaker = _Speaker({**arguments, "settings": settings}, progress)
    except (OSError, ValueError):  # no process is to be had, or none that inherits a socket
        return _speak_here(arguments, settings, progress)
    with speaker:
        cache = _prepare(settings, progress, speaker)
        try:
            take = speaker.take()
        except LostSpeakerError:
            take = _speak_here(arguments, settings, progress)
        return replace(take, cache=cache)


def _speak_here(arguments: Mapping[str, Any], settings: Settings, progress: Progress) -> Take:
    from .api import speak

    return speak(**arguments, settings=settings, progress=progress)


def _prepare(settings: Settings, progress: Progress, speaker: _Speaker) -> HeadCache:
    """Load what draws pictures; between two steps tell what the speaker tells."""
    from .take import HeadCache

    cache = HeadCache()
    # What is wrong with a head or a look is told when the take is drawn, after what is wrong with a text.
    with contextlib.suppress(RisoriusError):
        for _ in _steps(settings, cache, progress):
            speaker.listen()
    return cache


def _steps(settings: Settings, cache: HeadCache, progress: Progress) -> Iterator[None]:
    """Load step by step what the pictures of a take wait for, by a take that rests."""
    import numpy as np

    from .core.parameters import NEUTRAL
    from .core.performance import Performance
    from .core.score import Score
    from .take import Take, with_profile

    rest = Performance(Score(1.0), settings.fps, np.array([NEUTRAL], np.float64))
    take = Take(rest, with_profile(settings), cache=cache)
    from .render import RendererSetup

    yield
    face = next(take.faces([0]))
    yield
    cache.prepare_renderer(RendererSetup(take.head, settings.size, settings.look, lambda: face, progress))


class _Speaker:
    """The process that speaks; a context manager, which ends it."""

    def __init__(self, arguments: Mapping[str, Any], progress: Progress) -> None:
        self._progress = progress
        self._answer: Take | RisoriusError | None = None
        self._process, self._connection = start_connected(_PROGRAM, stdout=DEVNULL, stderr=DEVNULL)
        self._connection.send(arguments)

    def listen(self) -> None:
        """Pass on what has come so far."""
        with contextlib.suppress(LostSpeakerError):
            while self._answer is None and self._has_come(0.0):
                self._receive()

    def take(self) -> Take:
        """Wait for the take; raise the error that the speaker met, or LostSpeakerError."""
        watch = Watch(self._process.pid)
        while self._answer is None:
            if self._has_come(LOOK):
                self._receive()
            else:
                try:
                    watch.look()
                except SilentError:
                    raise LostSpeakerError from None
        if isinstance(self._answer, RisoriusError):
            raise self._answer
        return self._answer

    def _has_come(self, seconds: float) -> bool:
        try:
            return self._connection.poll(seconds)
        except OSError:
            raise LostSpeakerError from None

    def _receive(self) -> None:
        try:
            kind, content = self._connection.recv()
        except (OSError, EOFError):
            raise LostSpeakerError from None
        if kind == _TOLD:
            self._progress(*content)
        elif kind == _WARNED:
            warn(content)
        else:
            self._answer = content

    def __enter__(self) -> _Speaker:
        return self

    def __exit__(self, *_: object) -> None:
        end_connected(self._process, self._connection, LOOK if self._answer is not None else 0.0)


def _answers(connection: Connection) -> None:
    """Perform what comes through a connection, and send what is told on the way, then the take."""
    from .api import speak

    def tell(*content: object) -> None:
        connection.send((_TOLD, content))

    try:
        with warnings_to(lambda line: connection.send((_WARNED, line))):
            take = speak(**connection.recv(), progress=tell)
    except RisoriusError as error:
        connection.send((_FAILED, error))
    else:
        connection.send((_DONE, take))


def main() -> int:
    """Perform once; whoever interrupts the run interrupts the other process, which ends this one."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    collect_seldom()
    with Connection(int(sys.argv[1])) as connection, contextlib.suppress(BrokenPipeError, EOFError):
        _answers(connection)
    collect_no_more()
    return 0


if __name__ == "__main__":
    sys.exit(main())
