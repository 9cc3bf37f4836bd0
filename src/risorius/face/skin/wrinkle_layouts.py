"""Layouts of creases: the place of a wrinkle region on the face, and the way its creases run.

A layout assigns each point of the skin a phase, with creases at the integers (paper B's isolines), a mask,
and the direction in which the skin must shorten to fold.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple, Protocol

import numpy as np

from ...core.arrays import Array, Int64Array
from ...core.units import Share
from ...errors import InputError
from ...machine.kernels.jit import kernel
from ...reading.hints import Range, Then
from ..head.face_coordinates import FaceCoordinates, plateau, ripple, smooth


def _some(anchor: tuple[int, ...]) -> tuple[int, ...]:
    if not anchor:
        raise InputError("there is no landmark; expected at least one")
    return anchor


def _knots(points: tuple[tuple[float, float, float], ...]) -> tuple[tuple[float, float, float], ...]:
    if len(points) < 2 or any(point[0] not in range(68) for point in points):
        raise InputError("expected at least two points [landmark 0 to 67, dx, dy]")
    return points


PlateauEdges = tuple[float, float, float, float]
"""The four edges of a plateau: it begins, is full from, is full until, ends (`marks.plateau`)."""
Landmark = Annotated[int, Range(0, 67)]
"""A number of the 68 landmarks of iBUG."""
Landmarks = Annotated[tuple[Landmark, ...], Then(_some)]
Vector = tuple[float, float, float]
Millimetres = Annotated[float, Range(0.0, 200.0)]
Spacing = Annotated[float, Range(0.1, 200.0)]

_BREAK_LENGTH = 15.0  # mm along a crease over which it fades and returns
_BEHIND = (-55.0, -40.0)  # mm behind the anchor, between which the front of the face ends
_CURVE_STEPS = 12  # straight pieces between two points of a fold


class Chart(NamedTuple):
    """A region on points (n,): phase in creases, mask 0..1, and the unit direction of compression (n, 3)."""

    phase: Array
    mask: Array
    pull: Array


class Layout(Protocol):
    """A way to lay creases on a face."""

    def chart(self, marks: FaceCoordinates, places: Array) -> Chart:
        """Return the region on `places` (n, 3), points of the left half in the tables' mm."""
        ...


@dataclass(frozen=True, slots=True)
class Lines:
    """Parallel creases, each with a strength; keys as in `wrinkles.toml`."""

    anchor: Landmarks
    across: Vector
    along: Vector
    first: float
    spacing: Spacing
    strengths: tuple[Share, ...]
    across_range: PlateauEdges
    along_range: PlateauEdges
    bow: float
    wave: float
    breaks: Share

    def chart(self, marks: FaceCoordinates, places: Array) -> Chart:
        """Return the region on `places` (n, 3)."""
        offset = places - marks.mean(self.anchor)
        across, along = offset @ _unit(self.across), offset @ _unit(self.along)
        bent = across + self.bow * along**2 + self.wave * ripple(places[:, :2], 30.0, 1)
        phase = (bent - self.first) / self.spacing
        mask = plateau(self.across_range, across) * plateau(self.along_range, along)
        mask *= smooth(*_BEHIND, offset[:, 2])
        mask *= _strength(self.strengths, phase, along, self.breaks)
        return Chart(phase, mask, np.tile(_unit(self.across), (len(places), 1)))


@dataclass(frozen=True, slots=True)
class Fan:
    """Creases that radiate from a point, `spacing` degrees apart; keys as in `wrinkles.toml`."""

    anchor: Landmarks
    outward: Vector
    upward: Vector
    first: float
    spacing: Spacing
    strengths: tuple[Share, ...]
    angle_range: PlateauEdges
    radius_range: PlateauEdges
    wave: float
    breaks: Share

    def chart(self, marks: FaceCoordinates, places: Array) -> Chart:
        """Return the region on `places` (n, 3)."""
        offset = places - marks.mean(self.anchor)
        outward, upward = _unit(self.outward), _unit(self.upward)
        out, up = offset @ outward, offset @ upward
        radius, angle = np.hypot(out, up), np.degrees(np.arctan2(up, out))
        wavy = angle + np.degrees(self.wave * ripple(places, 14.0, 3)) / np.maximum(radius, 4.0)
        phase = (wavy - self.first) / self.spacing
        mask = plateau(self.angle_range, angle) * plateau(self.radius_range, radius)
        mask *= smooth(
            14.0, 9.0, np.linalg.norm(offset - np.outer(out, outward) - np.outer(up, upward), axis=1)
        )
        mask *= _strength(self.strengths, phase, radius, self.breaks)
        ring = np.outer(out, upward) - np.outer(up, outward)
        return Chart(phase, mask, ring / np.maximum(radius, 1e-6)[:, None])


@dataclass(frozen=True, slots=True)
class Fold:
    """One crease along a curve, with the fuller side beyond it; keys as in `wrinkles.toml`."""

    points: Annotated[tuple[Vector, ...], Then(_knots)]
    sides: tuple[float, float]
    ends: PlateauEdges
    compression: Vector
    muscles: tuple[str, ...] = ()
    gathers: Share = 0.0

    def chart(self, marks: FaceCoordinates, places: Array) -> Chart:
        """Return the region on `places` (n, 3); its phase is 0 on the crease, 1 where the far side ends."""
        knots = np.array([marks.landmarks[int(k), :2] + (x, y) for k, x, y in self.points])
        side, way = _beside(_curve(knots), places[:, :2])
        before, beyond = self.sides
        front = smooth(-25.0, -5.0, places[:, 2])
        mask = plateau(self.ends, way) * plateau((-before, -0.4 * before, 0.5 * beyond, beyond), side) * front
        return Chart(side / beyond, mask, np.tile(_unit(self.compression), (len(places), 1)))


@dataclass(frozen=True, slots=True)
class Dimples:
    """Pits in an ellipse; keys as in `wrinkles.toml`."""

    anchor: Landmarks
    offset: float
    spacing: Spacing
    size: tuple[Spacing, Spacing]
    muscle: str
    gathers: Share

    def chart(self, marks: FaceCoordinates, places: Array) -> Chart:
        """Return the region on `places` (n, 3); its phase is 0."""
        centre = marks.mean(self.anchor) + np.array([0.0, self.offset, 0.0])
        return Chart(
            np.zeros(len(places)),
            spot(places, centre, self.size),
            np.zeros_like(places),
        )


def spot(places: Array, centre: Array, size: tuple[float, float]) -> Array:
    """Return a soft ellipse (n,), 1 at its centre, 0 beyond `size` mm, only on the front of the face."""
    offset = places - centre
    radius = np.hypot(offset[:, 0] / size[0], offset[:, 1] / size[1])
    return (1.0 - smooth(0.15, 1.0, radius)) * (1.0 - smooth(20.0, 35.0, np.abs(offset[:, 2])))


def _unit(vector: tuple[float, float, float]) -> Array:
    """Return a vector at length 1; a null vector stays null."""
    return np.asarray(vector) / max(float(np.linalg.norm(vector)), 1e-12)


def _strength(strengths: tuple[float, ...], phase: Array, along: Array, breaks: float) -> Array:
    """Return the strength (n,) of the nearest creases at a phase, with gaps along each of them."""
    low = np.floor(phase)
    share = phase - low
    return (1.0 - share) * _one(strengths, low, along, breaks) + share * _one(
        strengths, low + 1.0, along, breaks
    )


def _one(strengths: tuple[float, ...], number: Array, along: Array, breaks: float) -> Array:
    index = number.astype(int)
    exists = (index >= 0) & (index < len(strengths))
    strength = np.where(exists, np.asarray(strengths)[np.clip(index, 0, len(strengths) - 1)], 0.0)
    # Each crease samples the ripple at its own place.
    gaps = ripple(np.stack([along, 41.0 * number], axis=1), _BREAK_LENGTH, 5)
    return strength * np.clip(1.0 + breaks * (gaps - 0.35), 0.0, 1.0)


def _curve(knots: Array) -> Array:
    """Return points (m, 2) on the Catmull-Rom spline through `knots` (k, 2)."""
    ends = np.vstack([2.0 * knots[0] - knots[1], knots, 2.0 * knots[-1] - knots[-2]])
    t = np.linspace(0.0, 1.0, _CURVE_STEPS, endpoint=False)[:, None]
    pieces = []
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:], strict=False):
        cubic = (3.0 * (b - c) + d - a) * t**3 + (2.0 * a - 5.0 * b + 4.0 * c - d) * t**2
        pieces.append(b + 0.5 * (cubic + (c - a) * t))
    return np.vstack([*pieces, knots[-1:]])


def _beside(curve: Array, places: Array) -> tuple[Array, Array]:
    """Return how far `places` (n, 2) are beyond a curve that runs down, and their share 0..1 along it."""
    length = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    side, piece, share = np.empty(len(places)), np.empty(len(places), np.int64), np.empty(len(places))
    _find_nearest(curve, np.ascontiguousarray(places), side, piece, share)
    start = np.concatenate([[0.0], np.cumsum(length)])
    return side, (start[piece] + share * length[piece]) / start[-1]


@kernel("f8[:, :], f8[:, :], f8[:], i8[:], f8[:]")
def _find_nearest(curve: Array, places: Array, side: Array, piece: Int64Array, share: Array) -> None:
    """Write each place's (n, 2) distance beyond the curve (k, 2), nearest piece, and share along it."""
    for i in range(len(places)):
        nearest = np.inf
        for j in range(len(curve) - 1):
            dx, dy = curve[j + 1, 0] - curve[j, 0], curve[j + 1, 1] - curve[j, 1]
            x, y = places[i, 0] - curve[j, 0], places[i, 1] - curve[j, 1]
            s = min(max((x * dx + y * dy) / (dx * dx + dy * dy), 0.0), 1.0)
            x, y = x - s * dx, y - s * dy
            apart = x * x + y * y
            if apart < nearest:
                nearest, piece[i], share[i] = apart, j, s
                side[i] = np.sqrt(apart) * np.sign(dx * y - dy * x)
