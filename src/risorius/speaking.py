"""Speak in a worker, while this process loads what draws: the solver, the renderer and their kernels.

To speak and plan takes nearly as long as to load these, and each is work for one core.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from .errors import RisoriusError, warn, warnings_to
from .machine.garbage import collect_seldom
from .machine.processes import processors
from .machine.workers import Worker, WorkerError

if TYPE_CHECKING:
    from .core.progress import Progress
    from .settings import Settings
    from .take import HeadCache, Take

TASK = "risorius.speaking:perform"
_SECONDS = 3600.0  # until the worker tells more, or has the take


def speak_and_prepare(arguments: Mapping[str, Any], settings: Settings, progress: Progress) -> Take:
    """Return `api.speak` of some arguments, ready to draw the pictures that `settings` want.

    If no processor is free for a worker, or if it is lost, this process speaks. Raises as `api.speak`.
    """
    cache = None
    if processors() >= 2:
        with suppress(WorkerError), Worker() as worker:
            worker.send(TASK, {**arguments, "settings": settings}, tells=True)
            cache = load_head(settings, progress)
            return replace(_take(worker, progress), cache=cache)
    from .api import speak  # not sooner: this process rarely needs it

    take = speak(**arguments, settings=settings, progress=progress)
    return take if cache is None else replace(take, cache=cache)


def _take(worker: Worker, progress: Progress) -> Take:
    """Wait for the take, and pass on what the worker tells."""
    items = worker.items(_SECONDS)
    try:
        while True:
            warning, content = next(items)
            warn(content) if warning else progress(*content)
    except StopIteration as end:
        take: Take = end.value
        return take


def perform(tell: Callable[[tuple[bool, Any]], None], arguments: Mapping[str, Any]) -> Take:
    """Return `api.speak` of some arguments; tell warnings (True) and progress (False). A worker runs it."""
    from .api import speak

    collect_seldom()
    with warnings_to(lambda line: tell((True, line))):
        return speak(**arguments, progress=lambda *content: tell((False, content)))


def load_head(settings: Settings, progress: Progress) -> HeadCache:
    """Load what the pictures of a take wait for, by a take that rests."""
    import numpy as np

    from .core.parameters import NEUTRAL
    from .core.performance import Performance
    from .core.score import Score
    from .render import RendererSetup
    from .take import HeadCache, Take, with_profile

    rest = Performance(Score(1.0), settings.fps, np.array([NEUTRAL], np.float64))
    take = Take(rest, with_profile(settings), cache=(cache := HeadCache()))
    # What is wrong with a head or a look is told when the take is drawn, after what is wrong with a text.
    with suppress(RisoriusError):
        face = next(take.faces([0]))
        cache.prepare_renderer(RendererSetup(take.head, settings.size, settings.look, lambda: face, progress))
    return cache
