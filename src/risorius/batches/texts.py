"""Takes of many texts, by this process or by several: `risorius.pipe`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any

from ..api import speak
from ..errors import RisoriusError
from ..machine.worker_pool import Lost, WorkerPool
from ..rules.emotions import Displays
from ..settings import Settings
from ..take import Take

_AHEAD = 2  # texts that wait for each process


def takes(texts: Iterable[str], displays: Displays, settings: Settings, processes: int) -> Iterator[Take]:
    """Yield the takes of texts in their order; raises RisoriusError at one that cannot be performed."""
    if processes <= 1:
        for text in texts:
            yield perform_text(text, displays, settings)
        return
    with WorkerPool("risorius.batches.texts:perform_text", processes) as pool:
        pool.start()
        numbered, done, due = enumerate(texts), dict[int, Any](), 0
        for number, text in islice(numbered, _AHEAD * processes):
            pool.submit(number, text, displays, settings)
        while pool.busy:
            done |= pool.results()
            while due in done:
                yield _take(done.pop(due))
                due += 1
                for number, text in islice(numbered, 1):
                    pool.submit(number, text, displays, settings)


def perform_text(text: str, displays: Displays, settings: Settings) -> Take:
    """Return the take of a text; workers run it. Raises RisoriusError if it cannot be performed."""
    return speak(text, text=True, emotion=displays, settings=settings)


def _take(answer: Take | RisoriusError | Lost) -> Take:
    if isinstance(answer, RisoriusError):
        raise answer
    if isinstance(answer, Lost):
        raise RisoriusError(f"a text could not be performed: {answer.reason}")
    return answer
