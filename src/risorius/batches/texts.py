"""Takes of many texts, by this process or by several: `risorius.pipe`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import TYPE_CHECKING, Any

from ..errors import RisoriusError
from .pool import Lost, WorkerPool
from .text_task import Refusal, perform_text

if TYPE_CHECKING:
    from ..rules.emotions import Displays
    from ..settings import Settings
    from ..take import Take

_AHEAD = 2  # texts that wait for each process


def takes(texts: Iterable[str], displays: Displays, settings: Settings, processes: int) -> Iterator[Take]:
    """Yield the takes of texts in their order; raises RisoriusError at one that cannot be performed."""
    if processes <= 1:
        for text in texts:
            yield _take(perform_text(text, displays, settings))
        return
    with WorkerPool("text", processes) as pool:
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


def _take(answer: Take | Refusal | Lost) -> Take:
    if isinstance(answer, Refusal):
        raise answer.error()
    if isinstance(answer, Lost):
        raise RisoriusError(f"a text could not be performed: {answer.reason}")
    return answer
