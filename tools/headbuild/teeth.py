"""Teeth and gums by procedure: single crowns of anatomical sizes on an arch that fits behind the lips."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from risorius.core.arrays import AnyArray

from .arch import Arch

SCALE = 0.87  # the source's mouth is smaller than the anatomical mean
_AROUND = 14  # vertices around a crown
_GUM_COLUMNS = 6  # columns of the gum per tooth
_GUM_ROWS = 11


@dataclass(frozen=True)
class Crown:
    """One tooth, mm before scaling: width along the arch, height, thickness, and how far its edge stands
    beyond the jaw's edge line; `cusps` 0 for an incisor, 1 for a canine, 2 and more for the chewing
    teeth.
    """

    width: float
    height: float
    thickness: float
    beyond: float
    cusps: int


@dataclass(frozen=True)
class Row:
    """The teeth of one jaw from the midline outwards: `edge` is the y of the edge line, `down` +1 for the
    upper jaw.
    """

    arch: Arch
    edge: float
    down: float
    crowns: tuple[Crown, ...]


@dataclass(frozen=True)
class Part:
    """A triangle mesh: vertices (n, 3), triangles (m, 3), material (n,) 0 tooth, 1 gum."""

    vertices: AnyArray
    triangles: AnyArray
    material: AnyArray


# Mean crowns of permanent teeth (width, height, thickness as in dental anatomy); edges set for this face.
_UPPER = (
    Crown(8.5, 10.5, 6.4, 0.3, 0),
    Crown(6.6, 9.6, 5.6, -0.3, 0),
    Crown(7.5, 10.2, 7.4, 0.2, 1),
    Crown(7.0, 8.8, 8.6, -0.8, 2),
    Crown(6.9, 8.4, 8.6, -1.2, 2),
    Crown(10.0, 7.6, 10.0, -1.7, 4),
)
_LOWER = (
    Crown(5.3, 8.8, 5.6, 0.0, 0),
    Crown(5.8, 9.0, 5.8, 0.0, 0),
    Crown(6.9, 10.2, 7.0, 0.3, 1),
    Crown(7.0, 8.6, 7.4, -1.3, 2),
    Crown(7.0, 8.2, 7.8, -1.6, 2),
    Crown(10.6, 7.6, 9.6, -1.5, 4),
)


# mm by which the incisors' edges stand below the lips' line. Between parted lips 1.9 (men) to 3.4 mm (women)
# of the upper ones show (Vig and Brundo 1978, "The kinetics of anterior tooth display"), little of the lower.
_UPPER_EDGE, _LOWER_EDGE = 2.2, 0.4


def build_teeth(line: float) -> dict[str, Part]:
    """Upper and lower teeth with their gums for lips that meet at the height `line` (mm) at rest."""
    lower = Row(Arch(17.7, 0.0315), line - _LOWER_EDGE, -1.0, _LOWER)
    return {"teeth_upper": _row(_upper(line)), "teeth_lower": _row(lower)}


def incisor_edge(line: float) -> AnyArray:
    """The foremost point (3,) of the upper central incisors' edge, at the midline."""
    row = _upper(line)
    return np.array([0.0, row.edge - _UPPER[0].beyond * SCALE, row.arch.front - 0.3])


def _upper(line: float) -> Row:
    return Row(Arch(20.4, 0.0265), line - _UPPER_EDGE, 1.0, _UPPER)


def _row(row: Row) -> Part:
    crowns = [_crown(row, centre, crown, side) for side in (1.0, -1.0) for centre, crown in _centres(row)]
    gum = _gum(row)
    meshes = [*crowns, gum]
    offsets = np.cumsum([0] + [len(vertices) for vertices, _ in meshes])
    vertices = np.vstack([vertices for vertices, _ in meshes])
    triangles = np.vstack([t + o for (_, t), o in zip(meshes, offsets, strict=False)])
    material = np.zeros(len(vertices))
    material[offsets[-2] :] = 1.0
    return Part(vertices, triangles, material)


def _centres(row: Row) -> list[tuple[float, Crown]]:
    """Position along the arch of each crown's middle."""
    ends = np.cumsum([0.0] + [crown.width * SCALE for crown in row.crowns])
    return [(float(a + b) / 2.0, crown) for a, b, crown in zip(ends, ends[1:], row.crowns, strict=False)]


def _crown(row: Row, centre: float, crown: Crown, side: float) -> tuple[AnyArray, AnyArray]:
    """Rings from the neck (below the gum's margin) to the edge, closed by one vertex."""
    half, height, thick = (SCALE * v for v in (crown.width / 2.0, crown.height, crown.thickness))
    levels = np.array([-0.25, 0.0, 0.2, 0.42, 0.64, 0.82, 0.92, 0.975, 1.0])
    shrink = np.array([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.995, 0.96, 0.8])
    angle = np.arange(_AROUND) * 2.0 * np.pi / _AROUND
    across, out = _superellipse(angle, 2.6 if crown.cusps < 2 else 3.0)
    points = []
    for t, s in zip(levels, shrink, strict=True):
        wide = half * np.interp(t, [-0.3, 0.0, 0.38, 0.8, 1.0], _taper(crown)) * s
        front, back = _depths(crown, thick, t)
        middle = (front + back) / 2.0 if crown.cusps else front * 0.5 + back * 0.5
        v = middle + (front - back) / 2.0 * out * s
        u = wide * across
        y = t * height + _relief(crown, u / half, (v - middle) / thick, height) * max(0.0, t) ** 2
        points.append(_placed(row, centre, crown, side, u, v, y))
    tip = np.mean(points[-1], axis=0, keepdims=True)
    tip[:, 1] -= row.down * (0.15 if crown.cusps < 2 else -0.25)
    vertices = np.vstack([*points, tip])
    return vertices, _oriented(vertices, _tube(len(levels), _AROUND, cap=True))


def _taper(crown: Crown) -> list[float]:
    """Half width, as a share, at the neck's end, the neck, both ends of the contact, and the edge.

    Neighbours touch between the ends of the contact: no light shows between teeth above it, where the gum's
    papilla fills the gap, and little below.
    """
    if crown.cusps == 0:
        return [0.70, 0.82, 1.0, 1.0, 0.985]
    if crown.cusps == 1:
        return [0.70, 0.82, 1.0, 1.0, 0.9]
    return [0.76, 0.86, 1.0, 1.0, 0.88]


def _depths(crown: Crown, thick: float, t: float) -> tuple[float, float]:
    """Front and back of the section at height `t`, outward of the arch; the arch is the crowns' front at
    the edge.
    """
    if crown.cusps == 0:
        front = np.interp(t, [-0.3, 0.0, 0.35, 0.75, 1.0], [-0.25, 0.0, 0.35, 0.2, -0.15])
        back = front - thick * np.interp(t, [-0.3, 0.0, 0.25, 0.6, 1.0], [0.95, 0.92, 0.85, 0.48, 0.24])
    elif crown.cusps == 1:
        front = np.interp(t, [-0.3, 0.0, 0.35, 0.75, 1.0], [-0.1, 0.25, 0.7, 0.45, -0.25])
        back = front - thick * np.interp(t, [-0.3, 0.0, 0.25, 0.6, 1.0], [0.9, 0.9, 0.88, 0.62, 0.3])
    else:
        front = np.interp(t, [-0.3, 0.0, 0.4, 0.75, 1.0], [-0.3, 0.0, 0.35, 0.1, -0.6])
        back = front - thick * np.interp(t, [-0.3, 0.0, 0.4, 0.75, 1.0], [0.9, 0.94, 1.0, 0.96, 0.82])
    return float(front), float(back)


def _relief(crown: Crown, u: AnyArray, v: AnyArray, height: float) -> AnyArray:
    """How far the edge rises or falls: rounded corners, the canine's point, the cusps."""
    if crown.cusps == 0:
        return -0.025 * height * np.abs(u) ** 4
    if crown.cusps == 1:
        return -0.09 * height * np.abs(u) ** 1.3
    ridges = np.cos(np.pi * u) if crown.cusps == 2 else -np.cos(2.0 * np.pi * u)
    return 0.05 * height * ridges * np.sign(np.abs(v) - 0.1) - 0.08 * height * (np.abs(v) < 0.2)


def _placed(
    row: Row, centre: float, crown: Crown, side: float, u: AnyArray, v: AnyArray, y: AnyArray
) -> AnyArray:
    """Points (n, 3) of a crown at `u` along the arch, `v` outward and `y` from its neck towards its edge."""
    x, z = row.arch.place(np.full(len(u), centre) + u, v)
    edge = row.edge - row.down * crown.beyond * SCALE
    return np.stack([side * x, edge + row.down * (crown.height * SCALE - y), z], axis=1)


def _gum(row: Row) -> tuple[AnyArray, AnyArray]:
    """A ridge over all necks, scalloped: it rises between the teeth and falls at each tooth's middle."""
    turn = np.linspace(0.0, np.pi, _GUM_ROWS)
    profile = _gum_profile(row)
    points = []
    for s, m, b, d in np.vstack([profile[::-1] * [-1.0, 1.0, 1.0, 1.0], profile]):
        front, back = 0.75 - 0.55 * b, -d - 0.5 + 0.4 * b
        v = (front + back) / 2.0 + (front - back) / 2.0 * np.sign(np.cos(turn)) * np.abs(np.cos(turn)) ** 0.6
        depth = 7.0 * (1.0 - np.sin(turn) ** 0.7)
        x, z = row.arch.place(np.full(_GUM_ROWS, s), v)
        points.append(np.stack([x, m + row.down * depth, z], axis=1))
    vertices = np.vstack(points)
    return vertices, _oriented(vertices, _tube(len(points), _GUM_ROWS, cap=False, closed=False))


def _gum_profile(row: Row) -> AnyArray:
    """Columns of the left half, from the midline outwards (n, 4): position along the arch, y of the
    margin, how far between two teeth (0..1), thickness of the neck.
    """
    places = (np.arange(_GUM_COLUMNS) + 0.5) / _GUM_COLUMNS * 2.0 - 1.0
    papilla = np.abs(places) ** 3
    columns = []
    for centre, crown in _centres(row):
        edge = row.edge - row.down * crown.beyond * SCALE
        margin = edge + row.down * crown.height * SCALE * (0.94 - 0.30 * papilla)
        along = centre + crown.width * SCALE / 2.0 * places
        thick = np.full(_GUM_COLUMNS, 0.92 * crown.thickness * SCALE)
        columns.append(np.stack([along, margin, papilla, thick], axis=1))
    return np.vstack(columns)


def _superellipse(angle: AnyArray, power: float) -> tuple[AnyArray, AnyArray]:
    c, s = np.cos(angle), np.sin(angle)
    size = (np.abs(c) ** power + np.abs(s) ** power) ** (-1.0 / power)
    return c * size, s * size


def _tube(rings: int, around: int, *, cap: bool, closed: bool = True) -> AnyArray:
    """Triangles of rings of vertices, one after the other; `cap` joins the last ring to one more vertex."""
    columns = around if closed else around - 1
    faces = []
    for ring in range(rings - 1):
        for k in range(columns):
            a, b = ring * around + k, ring * around + (k + 1) % around
            faces += [[a, b, a + around], [b, b + around, a + around]]
    if cap:
        last = (rings - 1) * around
        faces += [[last + k, last + (k + 1) % around, last + around] for k in range(around)]
    return np.array(faces)


def _oriented(vertices: AnyArray, triangles: AnyArray) -> AnyArray:
    """The triangles, turned so that they face away from the mesh's inside (its signed volume about its
    mean).
    """
    a, b, c = (vertices[triangles[:, k]] - vertices.mean(axis=0) for k in range(3))
    outside = float((np.cross(a, b) * c).sum()) > 0.0
    return triangles if outside else triangles[:, ::-1]
