"""The lids: they slide over the eyeball on arcs, meet exactly when closed, and follow the gaze.

Each lid turns about the horizontal axis through its eyeball. The blink's field gives the path; what remains
to the goal of the two margins is carried by the plate of skin around the eye, so that the goal is met under
every other muscle; skin that others have carried the same way goes less far, as under parallel pulls. At
closure a the aperture is (1 − a) times what the other muscles and the gaze leave open.

The lids follow the vertical gaze (facts: science/03, section 3.7): the upper one most of the way, the lower
one enough to keep touching the iris.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import scipy.sparse as sp

from ..core.parameters import INDEX
from .head import Head
from .jit import compiled
from .plate import nearby, response, stiffness
from .products import carry

Array = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]

SIDES = ("left", "right")
BLINK = "orbicularis_oculi_palpebralis"
# Degrees of lid per degree of eye, and the most that the gaze alone moves a lid, degrees.
UPPER_GAIN = {"up": 0.75, "down": 0.80}
LOWER_GAIN = {"up": 0.65, "down": 0.55}
UPPER_MOST = {"up": 14.0, "down": 20.0}
LOWER_MOST = {"up": 12.0, "down": 16.0}
LOWER_SHARE = 0.08  # of a closure's way, gone by the lower lid
CLEARANCE = 0.35  # mm of lid outside the eyeball; less only where the rest has less
FRONT = 0.15  # of the eyeball's radius: lids lie before this plane, the socket's lining behind it
LID_REACH = 7.0  # mm from the eyeball to the last vertex that is kept off it


def follow(pitch: float, gain: dict[str, float], most: dict[str, float]) -> float:
    """Return a lid's rotation in radians (up positive) for the eye's `pitch` in degrees."""
    way = "up" if pitch > 0.0 else "down"
    return float(np.radians(most[way] * np.tanh(gain[way] * pitch / most[way])))


@dataclass(frozen=True, slots=True)
class Lids:
    """The lids of one eye.

    closing        (k,) level-0 vertices that the blink moves
    angle          (k,) rad about the eye's horizontal axis at which they rest
    stroke         (k, 3) their way at closure: x mm, radius mm, angle rad
    margin         (2 m, N0) the margins' points at level 1, upper then lower
    margin_stroke  (m,) rad by which the blink alone brings them together
    taper          (m,) 1 at the middle of the eye, 0 at its corners
    region         (r,) level-0 vertices that move with the margins, `motion` (r, 2 m) how far with each
    shell          (s,) level-1 vertices, `floor` (s,) mm their least distance to `centre`
    """

    column: int
    centre: Array
    closing: IntArray
    angle: Array
    stroke: Array
    margin: sp.csr_matrix
    margin_stroke: Array
    taper: Array
    region: IntArray
    motion: Array
    shell: IntArray
    floor: Array

    @classmethod
    def of(cls, head: Head, eye: int, stiff: sp.csc_matrix) -> Lids:
        """Build the lids of eye 0 (left) or 1 (right); `stiff` is the skin's plate."""
        centre, radius = head.eye_centre[eye], float(head.eye_radius[eye])
        name = f"{BLINK}.{SIDES[eye]}"
        field = head.fields[name]
        at_rest = head.rest[field.vertices]
        before = _cylinder(at_rest - centre)
        stroke = _cylinder(at_rest + field.displacement - centre) - before
        pairs = head.lid_pairs[eye]
        margin: sp.csr_matrix = head.skin.matrix[pairs.T.ravel()].tocsr()
        spread = np.zeros((len(head.rest), 3))
        spread[field.vertices] = stroke
        angles = (margin @ spread)[:, 2]
        apart = angles[len(pairs) :] - angles[: len(pairs)]
        plate = response(stiff, margin, nearby(head.rest, margin @ head.rest))
        shell, floor = _shell(head, centre, radius)
        return cls(
            INDEX[name],
            centre,
            field.vertices,
            np.ascontiguousarray(before[:, 2]),
            stroke,
            margin,
            apart,
            apart / apart.max(),
            plate.region,
            np.ascontiguousarray(plate.motion.T @ np.linalg.inv(plate.compliance)),
            shell,
            floor,
        )

    def close(self, skin: Array, closure: float, pitch: float) -> None:
        """Move the level-0 `skin` (N0, 3) in place: `closure` 0..1, the eye at `pitch` degrees."""
        count = len(self.taper)
        before = _cylinder(self.margin @ skin - self.centre)
        upper, lower = before[:count], before[count:]
        goal = self._goal(upper, lower, closure, pitch)
        drop = upper[:, 2] - goal[:count, 2]
        share = float(drop @ self.margin_stroke / (self.margin_stroke @ self.margin_stroke))
        _turn(skin, self.closing, self.angle, self.stroke, min(share, 1.0), self.centre)
        after = _cylinder(self.margin @ skin - self.centre)
        goal[:, :2] += self._side(after[:, :2], closure)
        carry(self.region, self.motion, _cartesian(goal) - _cartesian(after), skin)

    def _goal(self, upper: Array, lower: Array, closure: float, pitch: float) -> Array:
        """Return where the margins shall be (2 m, 3): the angles; the other two columns are 0."""
        up = upper[:, 2] + self.taper * follow(pitch, UPPER_GAIN, UPPER_MOST)
        low = lower[:, 2] + self.taper * follow(pitch, LOWER_GAIN, LOWER_MOST)
        gap = up - low
        overlap = np.maximum(-gap, 0.0) / 2.0
        closing = closure * np.maximum(gap, 0.0)
        goal = np.zeros((2 * len(gap), 3))
        goal[: len(gap), 2] = up + overlap - (1.0 - LOWER_SHARE) * closing
        goal[len(gap) :, 2] = low - overlap + LOWER_SHARE * closing
        return goal

    @staticmethod
    def _side(places: Array, closure: float) -> Array:
        """Return x and radius of the goal (2 m, 2): the margins meet half way as the lids close."""
        half = len(places) // 2
        middle = 0.5 * (places[:half] + places[half:])
        return np.asarray(places + closure * (np.vstack([middle, middle]) - places))

    def keep_off(self, skin: Array) -> None:
        """Push the level-1 `skin` (N1, 3) out of the eyeball in place."""
        _push_out(skin, self.shell, self.floor, self.centre)


def both_lids(head: Head) -> tuple[Lids, Lids]:
    """Return the lids of the left and the right eye."""
    stiff = stiffness(len(head.rest), head.quads)
    return Lids.of(head, 0, stiff), Lids.of(head, 1, stiff)


def _cylinder(points: Array) -> Array:
    """Return (x, radius, angle above +z) of points (n, 3) about the x axis."""
    x, y, z = points.T
    return np.column_stack([x, np.hypot(y, z), np.arctan2(y, z)])


def _cartesian(places: Array) -> Array:
    x, radius, angle = places.T
    return np.column_stack([x, radius * np.sin(angle), radius * np.cos(angle)])


def _shell(head: Head, centre: Array, radius: float) -> tuple[IntArray, Array]:
    rest = head.skin.matrix @ head.rest - centre
    distance = np.linalg.norm(rest, axis=1)
    near = (distance > radius) & (distance < radius + LID_REACH) & (rest[:, 2] > FRONT * radius)
    shell = np.flatnonzero(near).astype(np.int32)
    return shell, np.minimum(distance[shell], radius + CLEARANCE)


@compiled
def _turn(skin: Array, vertices: IntArray, rest: Array, stroke: Array, share: float, centre: Array) -> None:
    for k in range(len(vertices)):
        v = vertices[k]
        y, z = skin[v, 1] - centre[1], skin[v, 2] - centre[2]
        radius = np.hypot(y, z) + share * stroke[k, 1]
        angle = np.arctan2(y, z)
        angle += _limited(share * stroke[k, 2], angle - rest[k])
        skin[v, 0] += share * stroke[k, 0]
        skin[v, 1] = centre[1] + radius * np.sin(angle)
        skin[v, 2] = centre[2] + radius * np.cos(angle)


@compiled
def _limited(way: float, gone: float) -> float:
    """Return what is left of a `way` for skin that others have `gone` along: as of two parallel pulls."""
    if way * gone <= 0.0:
        return way
    return float(np.cbrt(way * way * way + gone * gone * gone) - gone)


@compiled
def _push_out(skin: Array, shell: IntArray, floor: Array, centre: Array) -> None:
    for k in range(len(shell)):
        v = shell[k]
        x, y, z = skin[v, 0] - centre[0], skin[v, 1] - centre[1], skin[v, 2] - centre[2]
        distance = np.sqrt(x * x + y * y + z * z)
        if distance < floor[k]:
            grow = floor[k] / distance
            skin[v, 0] = centre[0] + x * grow
            skin[v, 1] = centre[1] + y * grow
            skin[v, 2] = centre[2] + z * grow
