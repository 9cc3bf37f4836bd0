"""Long work that can be stopped: its reports of progress are where it stops."""

from __future__ import annotations

import threading

from ..core.progress import Progress
from ..errors import RisoriusError


class StoppedError(RisoriusError):
    """Work was stopped."""


def stoppable(progress: Progress, stopped: threading.Event, what: str) -> Progress:
    """Return `progress` that raises StoppedError once `stopped` is set, on the thread that reports first.

    Another thread may report that the start takes long: an error there would not stop the work.
    """
    working: list[int] = []

    def told(stage: str, done: int = 0, total: int = 0) -> None:
        if not working:
            working.append(threading.get_ident())
        if stopped.is_set() and threading.get_ident() == working[0]:
            raise StoppedError(what)
        progress(stage, done, total)

    return told
