"""The lids: they slide over the eyeball on arcs, meet exactly when closed, and follow the gaze.

Each lid turns about the horizontal axis through its eyeball along the path of the blink's field. The plate of
skin around the eye moves the margins the rest of the way to their goal, so that they reach it whatever other
muscles do; skin that others have moved in the same direction goes less far, as under parallel pulls. At
closure a the aperture is (1 − a) times the opening that the other muscles and the gaze leave.

The lids follow the vertical gaze (facts: science/03, section 3.7): the upper one most of the way, the lower
one enough to keep touching the iris.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from ...core.arrays import Array, Int32Array
from ...core.parameters import INDEX
from ...machine.kernels.jit import device, kernel
from ..head.head import Head
from ..numerics.sparse import SparseRows, carry
from .plate import nearby, plate_compliance

SIDES = ("left", "right")
BLINK = "orbicularis_oculi_palpebralis"
# Degrees of lid per degree of eye, and the most that the gaze alone moves a lid, degrees.
UPPER_GAIN = {"up": 0.75, "down": 0.80}
LOWER_GAIN = {"up": 0.65, "down": 0.55}
UPPER_MOST = {"up": 14.0, "down": 20.0}
LOWER_MOST = {"up": 12.0, "down": 16.0}
LOWER_SHARE = 0.08  # the lower lid's share of the way to a closure
CLEARANCE = 0.35  # mm between lid and eyeball; less only for vertices that are nearer at rest
FRONT = 0.15  # of the eyeball's radius: lids lie before this plane, the socket's lining behind it
LID_REACH = 7.0  # mm from the eyeball to the farthest vertex that is pushed out of it


def follow(pitch: float, gain: dict[str, float], most: dict[str, float]) -> float:
    """Return a lid's rotation in radians (up positive) for the eye's `pitch` in degrees."""
    way = "up" if pitch > 0.0 else "down"
    return math.radians(most[way] * math.tanh(gain[way] * pitch / most[way]))


@dataclass(frozen=True, slots=True)
class Lids:
    """The lids of one eye.

    closing        (k,) level-0 vertices that the blink moves
    angle          (k,) rad about the eye's horizontal axis at which they rest
    path           (k, 3) their displacement at closure: x mm, radius mm, angle rad
    margin         rows (2 m, N0) of the margins' points at level 1, upper then lower
    margin_path    (m,) rad by which the blink alone brings them together
    taper          (m,) 1 at the middle of the eye, 0 at its corners
    region         (r,) level-0 vertices that move with the margins, `motion` (2 m, r) how far with each
    shell          (s,) level-1 vertices, `floor` (s,) mm their least distance to `centre`
    work           scratch: the margins' places and displacements (2 m, 4), the region's displacements (3, r)
    """

    column: int
    centre: Array
    closing: Int32Array
    angle: Array
    path: Array
    margin: SparseRows
    margin_path: Array
    taper: Array
    region: Int32Array
    motion: Array
    shell: Int32Array
    floor: Array
    work: tuple[Array, Array, Array]

    @classmethod
    def of(cls, head: Head, eye: int) -> Lids:
        """Build the lids of eye 0 (left) or 1 (right)."""
        centre, radius = head.eye_centre[eye], float(head.eye_radius[eye])
        name = f"{BLINK}.{SIDES[eye]}"
        field = head.fields[name]
        at_rest = head.rest[field.vertices]
        before = _cylinder(at_rest - centre)
        path = _cylinder(at_rest + field.displacement - centre) - before
        pairs = head.lid_pairs[eye]
        margin: sp.csr_matrix = head.skin.matrix[pairs.T.ravel()].tocsr()
        spread = np.zeros((len(head.rest), 3))
        spread[field.vertices] = path
        angles = (margin @ spread)[:, 2]
        apart = angles[len(pairs) :] - angles[: len(pairs)]
        plate = plate_compliance(head.quads, margin, nearby(head.rest, margin @ head.rest))
        shell, floor = _shell(head, centre, radius)
        return cls(
            INDEX[name],
            centre,
            field.vertices,
            np.ascontiguousarray(before[:, 2]),
            path,
            SparseRows.of(margin),
            apart,
            apart / apart.max(),
            plate.region,
            np.ascontiguousarray(np.linalg.inv(plate.compliance).T @ plate.motion),
            shell,
            floor,
            (np.empty((2 * len(pairs), 4)), np.empty((2 * len(pairs), 4)), np.empty((3, len(plate.region)))),
        )

    def close(self, skin: Array, closure: float, pitch: float) -> None:
        """Move the level-0 `skin` (N0, 4) in place: `closure` 0..1, the eye at `pitch` degrees."""
        up, down = follow(pitch, UPPER_GAIN, UPPER_MOST), follow(pitch, LOWER_GAIN, LOWER_MOST)
        places, goal, sums = self.work
        self.margin.times(skin, places)
        share = _aim(places, self.centre, self.taper, self.margin_path, closure, up, down, goal)
        if share != 0.0:
            _turn(skin, self.closing, self.angle, self.path, min(share, 1.0), self.centre)
            self.margin.times(skin, places)
        _rest_of_the_way(places, self.centre, closure, goal)
        carry(self.region, self.motion, goal, sums, skin)

    def keep_off(self, skin: Array) -> None:
        """Push the level-1 `skin` (N1, 4) out of the eyeball in place."""
        _push_out(skin, self.shell, self.floor, self.centre)


def both_lids(head: Head) -> tuple[Lids, Lids]:
    """Return the lids of the left and the right eye."""
    return Lids.of(head, 0), Lids.of(head, 1)


def _cylinder(points: Array) -> Array:
    """Return (x, radius, angle above +z) of points (n, 3) about the x axis."""
    x, y, z = points.T
    return np.column_stack([x, np.hypot(y, z), np.arctan2(y, z)])


def _shell(head: Head, centre: Array, radius: float) -> tuple[Int32Array, Array]:
    rest = head.skin.matrix @ head.rest - centre
    distance = np.linalg.norm(rest, axis=1)
    near = (distance > radius) & (distance < radius + LID_REACH) & (rest[:, 2] > FRONT * radius)
    shell = np.flatnonzero(near).astype(np.int32)
    return shell, np.minimum(distance[shell], radius + CLEARANCE)


@kernel("f8[:, :], f8[:], f8[:], f8[:], f8, f8, f8, f8[:, :] -> f8")
def _aim(
    places: Array,
    centre: Array,
    taper: Array,
    path: Array,
    closure: float,
    up: float,
    down: float,
    goal: Array,
) -> float:
    """Write the goal angles of the margins at `places` (2 m, 4) to the third column of `goal` (2 m, 4).

    `up` and `down` are the rotations in radians by which upper and lower lid follow the gaze. Returns the
    share of the blink's own `path` (m,) that brings the upper lid nearest to its goal.
    """
    count = len(taper)
    drop, square = 0.0, 0.0
    for k in range(count):
        upper, lower = _angle(places, k, centre), _angle(places, count + k, centre)
        high, low = upper + taper[k] * up, lower + taper[k] * down
        overlap, closing = 0.5 * max(low - high, 0.0), closure * max(high - low, 0.0)
        goal[k, 2] = high + overlap - (1.0 - LOWER_SHARE) * closing
        goal[count + k, 2] = low - overlap + LOWER_SHARE * closing
        drop += (upper - goal[k, 2]) * path[k]
        square += path[k] * path[k]
    return float(drop / square)


@kernel("f8[:, :], f8[:], f8, f8[:, :]")
def _rest_of_the_way(places: Array, centre: Array, closure: float, goal: Array) -> None:
    """Replace `goal` (2 m, 4), whose third column has angles, by displacements in mm of `places` (2 m, 4).

    In x and radius the closing margins meet half way.
    """
    count = len(places) // 2
    for k in range(count):
        x = 0.5 * (places[k, 0] + places[count + k, 0])
        middle = 0.5 * (_radius(places, k, centre) + _radius(places, count + k, centre))
        for row in (k, count + k):
            radius, angle = _radius(places, row, centre), goal[row, 2]
            radius += closure * (middle - radius)
            goal[row, 0] = closure * (x - places[row, 0])
            goal[row, 1] = centre[1] + radius * np.sin(angle) - places[row, 1]
            goal[row, 2] = centre[2] + radius * np.cos(angle) - places[row, 2]


@device(inlined=True)
def _angle(points: Array, row: int, centre: Array) -> float:
    return float(np.arctan2(points[row, 1] - centre[1], points[row, 2] - centre[2]))


@device(inlined=True)
def _radius(points: Array, row: int, centre: Array) -> float:
    y, z = points[row, 1] - centre[1], points[row, 2] - centre[2]
    return float(np.sqrt(y * y + z * z))


@kernel("f8[:, :], i4[:], f8[:], f8[:, :], f8, f8[:]")
def _turn(skin: Array, vertices: Int32Array, rest: Array, path: Array, share: float, centre: Array) -> None:
    for k in range(len(vertices)):
        v = vertices[k]
        y, z = skin[v, 1] - centre[1], skin[v, 2] - centre[2]
        radius = np.sqrt(y * y + z * z)
        way = _limited(share * path[k, 2], np.arctan2(y, z) - rest[k])
        sine, cosine = np.sin(way), np.cos(way)
        grow = 1.0 + share * path[k, 1] / radius
        skin[v, 0] += share * path[k, 0]
        skin[v, 1] = centre[1] + grow * (y * cosine + z * sine)
        skin[v, 2] = centre[2] + grow * (z * cosine - y * sine)


@device()
def _limited(way: float, gone: float) -> float:
    """Return the rest of the angle `way` if other muscles moved the skin by `gone`: two parallel pulls."""
    if way * gone <= 1e-12:
        return way
    return float(np.cbrt(way * way * way + gone * gone * gone) - gone)


@kernel("f8[:, :], i4[:], f8[:], f8[:]")
def _push_out(skin: Array, shell: Int32Array, floor: Array, centre: Array) -> None:
    for k in range(len(shell)):
        v = shell[k]
        x, y, z = skin[v, 0] - centre[0], skin[v, 1] - centre[1], skin[v, 2] - centre[2]
        distance = np.sqrt(x * x + y * y + z * z)
        if distance < floor[k]:
            grow = floor[k] / distance
            skin[v, 0] = centre[0] + x * grow
            skin[v, 1] = centre[1] + y * grow
            skin[v, 2] = centre[2] + z * grow
