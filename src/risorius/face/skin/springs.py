"""The spring skin in motion: an implicit step of fixed length, whatever the frame rate.

m a = f − K x − c v (paper B, section 6.1, with the sign of the viscosity corrected: it opposes the velocity).
A step of h seconds solves (m + h c + h² K) v⁺ = m v + h (f − K x), x⁺ = x + h v⁺ with a matrix that is
factored once (facts: face-model, section 4).
"""

from __future__ import annotations

import math

import numpy as np

from ...core.arrays import Array, IndexArray, UInt32Array, UIntArray
from ...core.parameters import NAMES
from ...machine.kernels.jit import device, kernel
from ..head.coupled_muscles import NO_LINKS, Links
from ..muscles.muscles import AT_ONCE, DisplacedSkin, MuscleFields
from ..numerics.cholesky import substitute
from ..numerics.stiffness import REST
from .biphasic import Biphasic
from .network import Network, add_pull

RATE = 120  # steps in a second
STEP = 1.0 / RATE  # s
# Hz, and share of the critical damping, of a point on its spring to the rest alone; the step damps too.
# After a muscle that contracts in 0.1 s the skin overshoots by 3 to 7 %, and lags 3 to 11 ms behind it.
FREQUENCY, DAMPING = 8.0, 0.35
MASS = REST / (2.0 * math.pi * FREQUENCY) ** 2
VISCOSITY = 2.0 * DAMPING * 2.0 * math.pi * FREQUENCY * MASS


class Springs:
    """The state of a network: displacements and velocities of its free points, before the jaw turns them.

    `second_phase` adds springs that stiffen under strain. Two threads must not use one state at the same
    time.
    """

    def __init__(
        self,
        network: Network,
        fields: MuscleFields,
        links: Links = NO_LINKS,
        second_phase: Biphasic | None = None,
    ) -> None:
        self.network = network
        self._displaced, self._links = DisplacedSkin(fields.at(network.free)), links
        self._linked = np.zeros((AT_ONCE, len(NAMES)))
        self._second = second_phase
        stiffness = STEP**2 * (second_phase.stiffest if second_phase else 1.0)
        self._factor = network.factor(stiffness, MASS + STEP * VISCOSITY)
        shape = (len(network.free), 4)
        self._place, self._before, self._velocity = np.zeros(shape), np.zeros(shape), np.zeros(shape)
        self._strain = np.zeros(shape)

    def come_to_rest(self, values: Array) -> None:
        """Rest at the equilibrium for the activations `values` (46,)."""
        linked = self._links.apply(values, self._linked[0])
        self._place[:, :3] = self._displaced.at(linked)
        if self._second is not None:
            self._second.relax(linked, self._place)
        self._before[:] = self._place
        self._velocity[:] = 0.0

    def step(self, values: Array) -> None:
        """Go on by one step of 1 / RATE seconds, under the activations `values` (46,) at its end."""
        self.run(values[None])

    def run(self, values: Array) -> None:
        """Go on by steps, under the activations `values` (k, 46) at their ends."""
        for first in range(0, len(values), AT_ONCE):
            some = values[first : first + AT_ONCE]
            self.go_on(self.targets(some), 0, len(some))

    def targets(self, values: Array) -> Array:
        """Return where the muscles pull the points: (r, 3, AT_ONCE) mm, at the ends of the next few steps.

        `values` (k, 46) are the activations at at most AT_ONCE of them. The next call overwrites the result.
        """
        for row, linked in zip(values, self._linked, strict=False):
            self._links.apply(row, linked)
        return self._displaced.over(self._linked[: len(values)])

    def go_on(self, targets: Array, first: int, count: int) -> None:
        """Go on by `count` steps, whose ends are numbered from `first` on among the latest `targets`."""
        net, factor = self.network, self._factor
        solver = factor.start, factor.row, factor.weight, factor.inverse
        if self._second is None:
            state = self._strain, self._velocity, self._before, self._place
            _go_on(targets, first, count, net.start, net.column, net.weight, solver, state)
            if count % 2:
                self._before, self._place = self._place, self._before
            return
        for number in range(first, first + count):
            self._before, self._place = self._place, self._before
            _load(
                targets, number, self._before, net.start, net.column, net.weight, self._strain, self._velocity
            )
            self._second.pull(self._linked[number], self._before, STEP, self._velocity)
            _move(self._before, *solver, self._velocity, self._place)

    def place(self, share: float, displacement: Array) -> None:
        """Write the places of the points to the skin's `displacement` (N0, 3).

        `share`: 0 is before the last step, 1 after it.
        """
        _place(self.network.free, self._before, self._place, share, displacement)


@device("sums")
def _add_load(
    targets: Array,
    number: int,
    place: Array,
    start: UInt32Array,
    column: UInt32Array,
    weight: Array,
    strain: Array,
    velocity: Array,
) -> None:
    """Replace `velocity` (r, 4) by m v + h (f − K x); K is `start`, `column` and `weight` of the network."""
    for i in range(len(targets)):
        for c in range(3):
            strain[i, c] = targets[i, c, number] - place[i, c]
            velocity[i, c] *= MASS
    add_pull(start, column, weight, strain, STEP, velocity)


@device("sums")
def _move_on(
    before: Array,
    start: UInt32Array,
    row: UIntArray,
    weight: Array,
    inverse: Array,
    velocity: Array,
    after: Array,
) -> None:
    """Solve for the new `velocity` (r, 4) by the tables of a `Factor`; write the places `after` the step."""
    substitute(start, row, weight, inverse, velocity)
    for i in range(len(after)):
        for c in range(3):
            after[i, c] = before[i, c] + STEP * velocity[i, c]


@kernel("f8[:, 3, 4], i8, f8[:, 4], u4[:], u4[:], f8[:], f8[:, 4], f8[:, 4]", arithmetic="sums")
def _load(
    targets: Array,
    number: int,
    place: Array,
    start: UInt32Array,
    column: UInt32Array,
    weight: Array,
    strain: Array,
    velocity: Array,
) -> None:
    _add_load(targets, number, place, start, column, weight, strain, velocity)


@kernel(
    "f8[:, 4], u4[:], u2[:], f8[:], f8[:], f8[:, 4], f8[:, 4]",
    "f8[:, 4], u4[:], u4[:], f8[:], f8[:], f8[:, 4], f8[:, 4]",
    arithmetic="sums",
)
def _move(
    before: Array,
    start: UInt32Array,
    row: UIntArray,
    weight: Array,
    inverse: Array,
    velocity: Array,
    after: Array,
) -> None:
    _move_on(before, start, row, weight, inverse, velocity, after)


@kernel(
    "f8[:, 3, 4], i8, i8, u4[:], u4[:], f8[:], (u4[:], u2[:], f8[:], f8[:]), "
    "(f8[:, 4], f8[:, 4], f8[:, 4], f8[:, 4])",
    "f8[:, 3, 4], i8, i8, u4[:], u4[:], f8[:], (u4[:], u4[:], f8[:], f8[:]), "
    "(f8[:, 4], f8[:, 4], f8[:, 4], f8[:, 4])",
    arithmetic="sums",
)
def _go_on(
    targets: Array,
    first: int,
    count: int,
    start: UInt32Array,
    column: UInt32Array,
    weight: Array,
    solver: tuple[UInt32Array, UIntArray, Array, Array],
    state: tuple[Array, Array, Array, Array],
) -> None:
    """Go on by `count` steps; the last two of the `state`, before and after a step, change roles in each."""
    strain, velocity, before, place = state
    for number in range(first, first + count):
        before, place = place, before
        _add_load(targets, number, before, start, column, weight, strain, velocity)
        _move_on(before, solver[0], solver[1], solver[2], solver[3], velocity, place)


@kernel("i8[:], f8[:, :], f8[:, :], f8, f8[:, :]", arithmetic="sums")
def _place(free: IndexArray, before: Array, after: Array, share: float, displacement: Array) -> None:
    for i in range(len(free)):
        for c in range(3):
            displacement[free[i], c] = before[i, c] + share * (after[i, c] - before[i, c])
