"""Solvers and stages that stay warm: one of each for a head as it looks, lent to one thread at a time."""

from __future__ import annotations

from collections.abc import AsyncIterator
from concurrent.futures import Executor
from contextlib import asynccontextmanager
from functools import lru_cache

from ...core.parameters import NEUTRAL
from ...face.head.head import head_of
from ...face.solve import FaceSolver
from ...looks.apply_look import apply_look
from ...ports.page.face_packer import FacePacker
from ...settings import Look, Settings
from ...solvers import SolverCache
from ..threads import on_thread

_MOST_IDLE = 4


class Solvers(SolverCache):
    """Builds solvers when they are asked for and keeps the last few that nobody uses."""

    def __init__(self) -> None:
        super().__init__(_MOST_IDLE)

    @asynccontextmanager
    async def loan(self, settings: Settings, threads: Executor) -> AsyncIterator[FaceSolver]:
        """Lend a solver to who must not wait: what has to be built is built on a thread."""
        lent = self.lent(settings)
        solver = await on_thread(threads, lent.__enter__)
        try:
            yield solver
        finally:
            lent.__exit__(None, None, None)

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
