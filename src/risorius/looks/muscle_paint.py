"""The muscles painted on the skin: fibres along a line of pull, or rings around the mouth and the eyes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..core.arrays import Array, BoolArray, Float32Array, IndexArray, Int64Array
from ..core.parameters import INDEX, MUSCLES
from ..face.head.head import Head, load_head
from ..face.head.muscle_table import Muscle
from ..machine.kernels.jit import f4
from .anatomy import Anatomy, find_anatomy
from .parts import skin_surface
from .surface import unit

SOFT = f4(0.9)  # mm: half the width of a painted muscle's soft edge
_OUTSIDE = -20.0  # mm

# Linear albedo of a muscle at rest, contracted, and suppressed by a rival (which glows).
_REST, _ACTIVE, _HOT = (
    np.array([0.40, 0.13, 0.11]),
    np.array([0.62, 0.015, 0.02]),
    np.array([1.5, 0.62, 0.05]),
)


class MusclePaint(NamedTuple):
    """The muscles on the skin.

    `covered` (m,) int64 has bit k set on the triangles that muscle k covers. `place` (N1, M, 2) is, in mm,
    the distance of a vertex inside the muscle's outline and its position across the fibres. `columns` (M,)
    are the muscles' numbers in the table of parameters.
    """

    covered: Int64Array
    place: Float32Array
    columns: IndexArray


@dataclass(frozen=True, slots=True)
class _Ring:
    """Fibres around the mouth or the left eye: half axes in mm of their middle, and half their width."""

    about: str
    across: float
    up: float
    half: float


@dataclass(frozen=True, slots=True)
class _Band:
    """Fibres along a line from origin to insertion (mm, the subject's left), `half` a width in mm."""

    origin: tuple[float, float, float]
    insertion: tuple[float, float, float]
    half: float


# Muscles whose row in the head's table has an axis or a direction instead of the line of their fibres.
_COURSES: dict[str, _Ring | _Band] = {
    "orbicularis_oris_presser": _Ring("mouth", 21.0, 11.0, 4.0),
    "orbicularis_oris_funneler": _Ring("mouth", 29.0, 19.0, 4.0),
    "orbicularis_oculi_palpebralis": _Ring("eye", 18.0, 10.5, 3.2),
    "orbicularis_oculi_orbitalis": _Ring("eye", 26.0, 18.5, 4.2),
    "levator_palpebrae": _Band((27.0, 13.0, 20.0), (27.0, 5.0, 17.0), 8.5),
    "mentalis": _Band((6.0, -80.0, 24.0), (8.0, -99.0, 20.0), 5.5),
    "masseter": _Band((58.0, -32.0, -28.0), (52.0, -84.0, -34.0), 10.0),
}
_SHEET = 0.46  # half the width of a sheet muscle, in widths of its zone
_LINEAR = 0.17  # the same of a band
_WITHIN = np.array([0.0, 0.0, -60.0])  # in the skull: muscles are painted on skin that faces away from here
_ENDS = 2.0  # mm by which a muscle is painted beyond its line


def place_muscles(head: Head, triangles: int) -> MusclePaint:
    """Place a head's muscles on its skin, for a scene of `triangles` triangles that starts with the skin's.

    The table holds places on the standard head; a head of the same mesh has them at the same vertices.
    """
    model = _model(head)
    anatomy = find_anatomy(model)
    normals = skin_surface(model, anatomy).normals
    rows, insides, ways, columns = model.muscles(), [], [], []
    for muscle in MUSCLES:
        course = _COURSES.get(muscle.base) or _band(rows[muscle.base][0])
        for side in (1.0, -1.0) if muscle.base == "masseter" else (-1.0 if muscle.side == "right" else 1.0,):
            inside, way = _painted(course, anatomy, model, normals, side)
            insides.append(np.clip(inside, _OUTSIDE, None))
            ways.append(way)
            columns.append(INDEX[muscle.name])
    place = np.stack([np.stack(insides, axis=1), np.stack(ways, axis=1)], axis=-1)
    covered = np.zeros(triangles, np.int64)
    faces = head.skin.triangles
    for k, inside in enumerate(insides):
        covered[: len(faces)] |= (inside[faces] > -float(SOFT)).any(axis=1).astype(np.int64) << k
    return MusclePaint(covered, np.ascontiguousarray(place, np.float32), np.array(columns, np.intp))


def colours(paint: MusclePaint, parameters: Array, suppression: Array) -> Float32Array:
    """Return colour and opacity (M, 4) float32 of each muscle.

    `parameters` (46,) are activations 0..1, `suppression` (46,) is how much rivals suppress each, 0..1.
    """
    active = np.clip(parameters[paint.columns], 0.0, 1.0)[:, None]
    hot = np.clip(1.6 * suppression[paint.columns], 0.0, 1.0)[:, None]
    colour = _REST + np.sqrt(active) * (_ACTIVE - _REST)
    colour = colour + hot * (_HOT - colour)
    opacity = np.maximum(0.30 + 0.66 * active**0.6, 0.95 * hot)
    return np.concatenate([colour, opacity], axis=1).astype(np.float32)


def _model(head: Head) -> Head:
    standard = load_head("standard")
    return standard if np.array_equal(standard.quads, head.quads) else head


def _band(row: Muscle) -> _Band:
    half = row.zone * (_SHEET if row.type == "sheet" else _LINEAR)
    return _Band(row.line[0], row.line[1], half)


def _painted(
    course: _Ring | _Band, anatomy: Anatomy, head: Head, normals: Array, side: float
) -> tuple[Array, Array]:
    """Return how far vertices (N1,) lie inside a course on one side, and their position across it, in mm."""
    mirrored = np.array([side, 1.0, 1.0])
    points = anatomy.skin * mirrored
    if isinstance(course, _Ring):
        centre = anatomy.mouth if course.about == "mouth" else head.eye_centre[0]
        inside, way, near = *_around(course, points, centre), points[:, 2] > centre[2] - 12.0
    else:
        inside, way, near = _along(course, points, normals * mirrored)
    return np.where(near & (anatomy.masks["inner_mouth"] < 0.4), inside, _OUTSIDE), way


def _around(ring: _Ring, points: Array, centre: Array) -> tuple[Array, Array]:
    x, y = (points[:, :2] - centre[:2]).T
    reach = np.hypot(x / ring.across, y / ring.up)
    # Distance from the middle of the ring, in the direction of the point.
    way = (reach - 1.0) * np.hypot(x, y) / np.maximum(reach, 1e-6)
    return ring.half - np.abs(way), way


def _along(band: _Band, points: Array, normals: Array) -> tuple[Array, Array, BoolArray]:
    origin, insertion = np.array(band.origin), np.array(band.insertion)
    length = float(np.linalg.norm(insertion - origin))
    ahead = (insertion - origin) / length
    along = (points - origin) @ ahead
    way = np.einsum("nd,nd->n", points - origin, unit(np.cross(normals, ahead)))
    spindle = band.half * (0.55 + 0.45 * np.sin(np.pi * np.clip(along / length, 0.0, 1.0)))
    inside = np.minimum(spindle - np.abs(way), np.minimum(along, length - along) + _ENDS)
    # Only near the line: points of the nape lie as far across as points of the brow.
    away = points - origin - np.clip(along, 0.0, length)[:, None] * ahead
    near = np.linalg.norm(away, axis=1) < max(band.half + 9.0, 16.0)
    return inside, way, near & (np.einsum("nd,nd->n", normals, unit(points - _WITHIN)) > 0.0)
