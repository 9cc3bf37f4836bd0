"""Biphasic springs: beyond a strain the skin stiffens, as collagen does (facts: science/09).

In addition to the linear network, each spring between neighbours with a strain above s₀ pulls with
k₂ (|s| − s₀) times its length at rest. A muscle's force includes what its own field at full contraction needs
against that, so that a single muscle stays exact there; several together move the skin less than with linear
springs.
"""

from __future__ import annotations

import numpy as np

from ...core.arrays import Array, IndexArray, UInt32Array
from ...machine.kernels.jit import kernel
from ..head.head import Field, Head
from ..muscles.muscles import MuscleFields, fields_of
from ..numerics.mesh_sides import edges
from ..numerics.stiffness import NEIGHBOUR
from .network import Network, pull

YIELD = 0.15  # strain s₀ at which the second phase begins
SECOND = 1.0  # stiffness k₂ of the second phase, added to the first
CONVERGED, MOST = 1e-3, 60  # mm of change in the last iteration, and the most iterations


class Biphasic:
    """The second phase of the springs about a network's free points, with the workspace of one state."""

    stiffest = 1.0 + SECOND / NEIGHBOUR
    """The greatest stiffness of a spring in its second phase, in units of its first."""

    def __init__(self, network: Network, fields: MuscleFields, head: Head) -> None:
        local = np.full(len(head.rest), -1)
        local[network.free] = np.arange(len(network.free))
        ends = edges(head.quads)
        ends = ends[(local[ends] >= 0).any(axis=1)]
        border = np.unique(ends[local[ends] < 0])
        local[border] = len(network.free) + np.arange(len(border))
        points = np.concatenate([network.free, border])
        self._network = network
        self._ends = local[ends].astype(np.uint32)
        self._length = head.rest[ends[:, 1]] - head.rest[ends[:, 0]]
        self._border = fields.at(border)
        self._points = np.zeros((len(points), 4))
        self._edge = np.zeros((len(border), 3))
        self._factor = network.factor(self.stiffest, 0.0)
        self._work = np.zeros((len(network.free), 4))
        self._fields = fields
        rows = fields_of(head)
        self._columns = np.array([row.column for row in rows])
        self._forces = np.stack([self._force_of(head, row.field, points) for row in rows])

    def _force_of(self, head: Head, field: Field, points: IndexArray) -> Array:
        """Return the force (r, 4) of the second phase that holds the field of a muscle at 1."""
        whole = np.zeros((len(head.rest), 4))
        whole[field.vertices, :3] = field.displacement
        out = np.zeros_like(self._work)
        _second_phase(self._ends, self._length, whole[points], -1.0, out)
        return out

    def pull(self, values: Array, place: Array, factor: float, out: Array) -> None:
        """Add `factor` times the second phase's forces to `out` (r, 4).

        `place` (r, 4) mm is where the free points are, `values` (46,) the activations.
        """
        self._border.displace(values, self._edge)
        self._points[: len(place)] = place
        self._points[len(place) :, :3] = self._edge
        _second_phase(self._ends, self._length, self._points, factor, out)
        activations = self._fields.activations(values)
        for column, force in zip(self._columns, self._forces, strict=True):
            if activations[column] > 0.0:
                _add(force, factor * activations[column], out)

    def relax(self, values: Array, place: Array) -> None:
        """Move `place` (r, 4) from the equilibrium of the linear springs to that with the second phase."""
        net, linear = self._network, place.copy()
        for _ in range(MOST):
            self._work[:] = 0.0
            pull(net.start, net.column, net.weight, linear - place, 1.0, self._work)
            self.pull(values, place, 1.0, self._work)
            self._factor.solve(self._work)
            place += self._work
            if np.abs(self._work).max() < CONVERGED:
                break

    def relax_skin(self, values: Array, displacement: Array) -> None:
        """Move the displacement (N0, 3) of the whole skin in the same way."""
        place = np.zeros_like(self._work)
        place[:, :3] = displacement[self._network.free]
        self.relax(values, place)
        displacement[self._network.free] = place[:, :3]


@kernel("u4[:, :], f8[:, :], f8[:, :], f8, f8[:, :]")
def _second_phase(ends: UInt32Array, length: Array, points: Array, factor: float, out: Array) -> None:
    for e in range(len(ends)):
        i, j = ends[e, 0], ends[e, 1]
        ax, ay, az = length[e, 0], length[e, 1], length[e, 2]
        bx = ax + points[j, 0] - points[i, 0]
        by = ay + points[j, 1] - points[i, 1]
        bz = az + points[j, 2] - points[i, 2]
        rest, now = np.sqrt(ax * ax + ay * ay + az * az), np.sqrt(bx * bx + by * by + bz * bz)
        over = abs(now - rest) - YIELD * rest
        if over <= 0.0 or now <= 0.0:
            continue
        force = factor * SECOND * np.copysign(over, now - rest) / now
        if i < len(out):
            out[i, 0] += force * bx
            out[i, 1] += force * by
            out[i, 2] += force * bz
        if j < len(out):
            out[j, 0] -= force * bx
            out[j, 1] -= force * by
            out[j, 2] -= force * bz


@kernel("f8[:, :], f8, f8[:, :]")
def _add(force: Array, factor: float, out: Array) -> None:
    for i in range(len(out)):
        for c in range(3):
            out[i, c] += factor * force[i, c]
