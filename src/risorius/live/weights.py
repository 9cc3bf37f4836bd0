"""ARKit weights of a live face's frames, as they come."""

from __future__ import annotations

import math
import os
from collections import deque
from collections.abc import Hashable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from threading import Lock

import numpy as np

from ..core.arrays import Array
from ..core.lips.closed_lips import shut_lips
from ..core.parameters import INDEX
from ..core.shape_weights import named_weights
from ..face.fit.arkit_fit import NO_WAY, ArkitFit
from ..face.fit.lip_file import load_lip_rig
from ..face.frame import FaceFrame
from ..face.head.eyes import pitch_and_yaw
from ..face.skin.springs import RATE
from ..face.solve import FaceSolver
from ..settings import Settings
from ..solvers import make_solver, solver_key
from .frame import LiveFrame

LONGEST = RATE
"""Steps of the skin after a gap: its earlier motion has faded in a second."""
_HEAD = [INDEX[f"head_{axis}"] for axis in ("yaw", "pitch", "roll")]
HEADS = 4
"""Heads that stay ready for the next live face."""


class LiveWeights:
    """Fits the frames of one live face, in order, with the inertia of its skin.

    The data of a head is made once, and shared by all live faces that show it. Raises HeadError if it cannot
    be loaded, or has no ARKit shapes.
    """

    def __init__(self, settings: Settings) -> None:
        self._solvers = solvers_of(settings)
        self._fps = settings.fps
        self._lips = load_lip_rig(settings.head)
        with self._solvers.one() as solver:
            self._springs = None if settings.dynamics == "static" else solver.springs()
            self._buffers = solver.buffers()
        self._before, self._at, self._step = np.zeros(0), Fraction(0), 0
        self._way: Array = NO_WAY

    def added(self, frame: LiveFrame) -> LiveFrame:
        """Return a frame with its weights and rotations; frames before it may have been left out."""
        with self._solvers.one() as solver:
            face = self._face(solver, Fraction(frame.index) / self._fps, frame.values)
            weights, self._way = self._solvers.fit.following(face, self._way)
        head = frame.values[_HEAD]
        eyes = [(yaw, pitch, 0.0) for pitch, yaw in map(pitch_and_yaw, face.eye_rotation)]
        rotations = np.radians(np.concatenate([head, *eyes]))
        shut = float(shut_lips(self._lips, frame.values[None])[0])
        return replace(frame, arkit=named_weights(weights), rotations=rotations, shut=shut)

    def _face(self, solver: FaceSolver, time: Fraction, values: Array) -> FaceFrame:
        if self._springs is None:
            return solver.solve(values, self._buffers)
        exact = time * RATE
        last = math.ceil(exact)
        if not len(self._before):
            self._springs.come_to_rest(values)
        else:
            self._go_to(last, exact, values)
        self._before, self._at, self._step = values, exact, last
        return solver.solve_moving(values, self._springs, float(1 - (last - exact)), self._buffers)

    def _go_to(self, last: int, exact: Fraction, values: Array) -> None:
        """Move the skin up to the step `last`, straight from the values of the frame before to these."""
        assert self._springs is not None
        first = max(self._step, last - LONGEST)
        steps = range(first + 1, last + 1)
        shares = np.array([min(float((step - self._at) / (exact - self._at)), 1.0) for step in steps])
        self._springs.run(self._before + shares[:, None] * (values - self._before))


class LiveSolvers:
    """The solvers of one head: as many as solve at a time, at most one for each processor.

    First come, first served, so that one late face that asks again at once does not delay the others.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._free = [make_solver(settings)]
        self._more = (os.cpu_count() or 1) - 1
        self._lock = Lock()
        self._waiting: deque[Future[FaceSolver]] = deque()
        self.fit = ArkitFit.of(self._free[0].head)

    def __len__(self) -> int:
        """The number of faces that wait for a solver."""
        return len(self._waiting)

    @contextmanager
    def one(self) -> Iterator[FaceSolver]:
        """Lend a solver."""
        solver = self._next()
        try:
            yield solver
        finally:
            self._give(solver)

    def _next(self) -> FaceSolver:
        turn: Future[FaceSolver] = Future()
        with self._lock:
            if self._free:
                return self._free.pop()
            if not self._more:
                self._waiting.append(turn)
            else:
                self._more -= 1
                turn.set_result(make_solver(self._settings))
        return turn.result()

    def _give(self, solver: FaceSolver) -> None:
        with self._lock:
            if self._waiting:
                self._waiting.popleft().set_result(solver)
            else:
                self._free.append(solver)


_making = Lock()


@dataclass(frozen=True, slots=True)
class _Head:
    """A head as settings shape it: settings with equal solvers are one head."""

    key: Hashable
    settings: Settings = field(compare=False)


def solvers_of(settings: Settings) -> LiveSolvers:
    """Return the solvers that all live faces with such a head share; those of the latest HEADS heads stay."""
    with _making:
        return _made(_Head(solver_key(settings), settings))


@lru_cache(maxsize=HEADS)
def _made(head: _Head) -> LiveSolvers:
    return LiveSolvers(head.settings)
