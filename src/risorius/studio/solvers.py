"""Solvers and stages that stay warm: one of each for a head as it looks, lent to one thread at a time."""

from __future__ import annotations

import threading
from collections.abc import AsyncIterator, Iterator
from concurrent.futures import Executor
from contextlib import asynccontextmanager, contextmanager
from functools import lru_cache

from ..core.parameters import NEUTRAL
from ..face.head import head_of
from ..face.solve import FaceSolver
from ..looks.apply_look import apply_look
from ..ports.face_packer import FacePacker
from ..settings import Look, Settings
from ..take import make_solver
from .threads import on_thread

_MOST_IDLE = 4


def _key(settings: Settings) -> tuple[object, ...]:
    wrinkles, shape = (tuple(sorted(amounts.items())) for amounts in (settings.wrinkles, settings.shape))
    return settings.head, settings.age, shape, settings.dynamics == "biphasic", wrinkles


class Solvers:
    """Builds solvers when they are asked for and keeps the last few that nobody uses."""

    def __init__(self) -> None:
        self._idle: list[tuple[tuple[object, ...], FaceSolver]] = []
        self._lock = threading.Lock()

    @contextmanager
    def lent(self, settings: Settings) -> Iterator[FaceSolver]:
        """Lend a solver as the settings want it."""
        key = _key(settings)
        solver = self._taken(key) or make_solver(settings)
        try:
            yield solver
        finally:
            with self._lock:
                self._idle = [(key, solver), *self._idle][:_MOST_IDLE]

    @asynccontextmanager
    async def loan(self, settings: Settings, threads: Executor) -> AsyncIterator[FaceSolver]:
        """Lend a solver to who must not wait: what has to be built is built on a thread."""
        lent = self.lent(settings)
        solver = await on_thread(threads, lent.__enter__)
        try:
            yield solver
        finally:
            lent.__exit__(None, None, None)

    def _taken(self, key: tuple[object, ...]) -> FaceSolver | None:
        with self._lock:
            for place, (known, solver) in enumerate(self._idle):
                if known == key:
                    del self._idle[place]
                    return solver
        return None

    def warm(self) -> None:
        """Compile and build what the first face needs: solvers for a take and for dials beside it."""
        with self.lent(Settings()) as solver, self.lent(Settings()):
            solver.solve(NEUTRAL)
            springs = solver.springs()
            springs.come_to_rest(NEUTRAL)
            springs.step(NEUTRAL)


@lru_cache(maxsize=4)
def stage_of(
    head: str, age: float | None = None, hair: str | None = None, complexion: float | None = None
) -> FacePacker:
    """Return the stage of a head that comes with Risorius."""
    from dataclasses import replace

    person = head_of(Settings(head=head, age=age))
    looks = apply_look(person.identity.looks, Look(hair=hair, complexion=complexion))
    return FacePacker(replace(person, identity=replace(person.identity, looks=looks)))
