"""The face in time: frames from curves, through the spring skin or without it.

The skin moves in steps of its own, driven by the curves at the times of those steps, so that a performance is
the same at every frame rate; a frame lies between two steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction

import numpy as np

from ..core.arrays import Array
from ..core.performance import Performance
from .frame import FaceFrame, FrameBuffers
from .muscles.muscles import AT_ONCE
from .skin.springs import RATE, Springs
from .solve import FaceSolver, checked_rows

Drive = Callable[[Array], Array]
"""All parameters (n, 46) at ascending times (n,) in seconds; of those that move no skin, any value."""

# Steps whose activations are computed at once: few after a jump, later many, which cost little more than one.
FIRST_BLOCK, LATER_BLOCK = RATE, 8 * RATE


def between_frames(performance: Performance) -> Drive:
    """Return the curves of `performance` between its frames: straight lines, constant beyond the ends."""
    values, times = performance.values, performance.times

    def drive(moments: Array) -> Array:
        after = np.clip(np.searchsorted(times, moments, side="right"), 1, max(len(times) - 1, 1))
        if len(times) == 1:
            return np.repeat(values, len(moments), axis=0)
        share = np.clip((moments - times[after - 1]) / (times[after] - times[after - 1]), 0.0, 1.0)[:, None]
        return np.asarray((1.0 - share) * values[after - 1] + share * values[after])

    return drive


def animate(
    performance: Performance,
    solver: FaceSolver,
    dynamics: bool = True,
    drive: Drive | None = None,
    indices: Sequence[int] | None = None,
    lead_in: float | None = None,
    buffers: FrameBuffers | None = None,
) -> Iterator[FaceFrame]:
    """Yield the face at every frame of `performance`, or at those in `indices`, one at a time.

    With `dynamics` the skin moves with its inertia and starts at rest in the first frame. Frames that are not
    in `indices` are computed too, so that the others do not depend on the choice; with `lead_in`, only those
    in the last `lead_in` seconds before the first one (see `Motion.start_before`). `drive` returns the curves
    between frames (None: straight lines); with the score's own curves, faces at one time agree at all frame
    rates. With `buffers` each frame overwrites the one before it. Raises ParameterError for a value that is
    not a number or out of range.
    """
    chosen = range(len(performance.values)) if indices is None else indices
    if not dynamics:
        yield from (solver.solve(performance.values[i], buffers) for i in chosen)
        return
    motion = Motion(solver, drive or between_frames(performance))
    if lead_in is not None and len(chosen):
        motion.start_before(Fraction(int(chosen[0])) / performance.fps, lead_in)
    for first in range(0, len(chosen), AT_ONCE):
        some = list(chosen[first : first + AT_ONCE])
        solver.expect(performance.values[some])
        for i in some:
            place = motion.go_to(Fraction(int(i)) / performance.fps)
            yield solver.solve_moving(performance.values[i], *place, buffers)


class Motion:
    """Moves the skin of `solver` along the curves of `drive`, from time 0 on."""

    def __init__(self, solver: FaceSolver, drive: Drive) -> None:
        self._springs, self._drive = solver.springs(), drive
        self._step = -1
        self._block, self._first = np.empty((0, 0)), 0
        self._targets, self._few = np.empty((0, 0, 0)), range(0)

    def go_to(self, time: Fraction) -> tuple[Springs, float]:
        """Go to `time` ≥ 0 in seconds; start again if that is in the past.

        Returns the skin after the step that reaches `time`, and the share of that step until `time`.
        """
        exact = time * RATE
        last = -(-exact.numerator // exact.denominator)
        if self._step < 0 or last < self._step:
            self._rest_at(0)
        while self._step < last:
            targets, number = self._targets_of(self._step + 1)
            count = min(last - self._step, len(self._few) - number)
            self._springs.go_on(targets, number, count)
            self._step += count
        return self._springs, float(1 - (last - exact))

    def start_before(self, time: Fraction, lead_in: float) -> None:
        """Start at rest `lead_in` seconds before `time`, or at 0.

        Earlier motion decays by a factor of e in 57 ms, so that after a second every point is right to 1e-6
        mm.
        """
        self._rest_at(max(0, math.floor((time - Fraction(lead_in)) * RATE)))

    def _rest_at(self, step: int) -> None:
        self._first, self._step = step, step
        self._block = self._values_from(step, FIRST_BLOCK)
        self._springs.come_to_rest(self._block[0])
        self._few = range(step, step)

    def _targets_of(self, step: int) -> tuple[Array, int]:
        """Return the targets of a few steps, and the number of `step` among them."""
        if step not in self._few:
            if step - self._first >= len(self._block):
                self._first, self._block = step, self._values_from(step, LATER_BLOCK)
            place = step - self._first
            values = self._block[place : place + AT_ONCE]
            self._few = range(step, step + len(values))
            self._targets = self._springs.targets(values)
        return self._targets, step - self._few.start

    def _values_from(self, step: int, count: int) -> Array:
        return checked_rows(self._drive(np.arange(step, step + count) / RATE))
