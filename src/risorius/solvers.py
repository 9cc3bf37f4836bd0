"""Solvers of faces: how they are made of settings, and a cache of those that stay warm."""

from __future__ import annotations

import threading
from collections.abc import Hashable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Literal

from .settings import Settings
from .settings.declare import Stage
from .unused_settings import values_read

if TYPE_CHECKING:
    from .core.muscle_coupling import Link
    from .face.solve import FaceSolver

_STAGES = (Stage.HEAD, Stage.SHAPE, Stage.SKIN)


def make_solver(settings: Settings) -> FaceSolver:
    """Return a solver for the head, wrinkles and skin that settings choose; HeadError as `head_of`."""
    from .face.head.coupled_muscles import Links
    from .face.head.head import head_of
    from .face.solve import FaceSolver

    head, links = head_of(settings), Links.of(links_of(settings))
    phases: Literal["linear", "biphasic"] = "biphasic" if settings.dynamics == "biphasic" else "linear"
    return FaceSolver(head, links, phases, age=head.identity.age, wrinkles=settings.wrinkles)


def links_of(settings: Settings) -> tuple[Link, ...]:
    """Return the links of muscles of the head that settings choose, as their rules change them."""
    from .face.head.coupled_muscles import link_rows
    from .face.head.head import head_of
    from .rules.rule_set import rule_set_of

    rows = link_rows(head_of(settings).links_file)
    if settings.rules is None:  # the package's own rules, which take a tenth of a second, change no head
        return rows
    return rule_set_of(settings.rules).tables.links(rows)


def solver_key(settings: Settings) -> Hashable:
    """Return what a solver is made of: settings with equal keys have equal solvers."""
    values = [value for stage in _STAGES for value in values_read(settings, stage)]
    amounts = (frozenset(value.items()) if isinstance(value, Mapping) else value for value in values)
    return *amounts, links_of(settings)


class SolverCache:
    """Keeps the latest `most` solvers that nobody has borrowed. A solver has a workspace for one thread.

    A copy, or what comes back from a pickle, is empty.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._idle: list[tuple[Hashable, FaceSolver]] = []
        self._lock = threading.Lock()

    def __reduce__(self) -> tuple[type[SolverCache], tuple[int]]:
        return SolverCache, (self._most,)

    def shared(self, settings: Settings) -> FaceSolver:
        """Return a solver, which stays here: its users must solve one after the other."""
        with self.lent(settings) as solver:
            return solver

    @contextmanager
    def lent(self, settings: Settings) -> Iterator[FaceSolver]:
        """Lend a solver as the settings want it, to one user at a time."""
        key = solver_key(settings)
        solver = self._taken(key) or make_solver(settings)
        try:
            yield solver
        finally:
            with self._lock:
                self._idle = [(key, solver), *self._idle][: self._most]

    def _taken(self, key: Hashable) -> FaceSolver | None:
        with self._lock:
            for index, (other, solver) in enumerate(self._idle):
                if other == key:
                    del self._idle[index]
                    return solver
        return None
