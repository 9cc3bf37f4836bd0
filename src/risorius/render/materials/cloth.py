"""Cloth: a knitted jersey with a ribbed collar."""

from __future__ import annotations

import math

from ...core.arrays import Float32Array
from ...looks.attributes import CURVATURE, EXTRA, OCCLUSION, SKIN
from ...looks.garment import COLLAR
from ...machine.kernels.jit import device, f4, index
from ...machine.kernels.vec import Vec, along, at, dot, mix, saturate, scale, smooth, times, unit, weigh
from ..grain import grain
from ..inputs import Batch, LinearTriangles, PosedMesh, SceneLight, Screen, Tables
from .exposure import expose
from .lit import ambient_light, lamp_colour, lamp_direction, lamp_share
from .shading_sample import Corners, corners_of, put, towards, weights_of
from .shadows import shadow_at

_RIBS = f4(110)  # around the neck
SEAM = f4(5)
"""Mm within which the collar's seam is seen."""
_CELLS, _LOW = f4(3.2), f4(0.6)  # cells of the grain per mm; stitches are higher than wide
STITCHES = (_CELLS, _LOW * _CELLS, _CELLS)
"""Cells of the grain per mm along x, y and z."""
THREAD = f4(0.09)
"""The share by which they change the albedo."""
UP = (f4(0), f4(1), f4(0))


@device("fast")
def shade_cloth(
    n: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, tables: Tables
) -> None:
    """Colour the patches of cloth among the first n of a row, and blend its edge into the skin's."""
    for k in range(n):
        if mesh.surfaces[batch.triangle[k]] != SKIN:
            continue
        corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
        depth = weigh(mesh.attributes, corners, weights, CURVATURE)[2]
        if depth >= -screen.pixel:
            woven = _cloth(mesh, screen, light, tables, corners, weights, depth)
            share = smooth(-screen.pixel, screen.pixel, depth)
            put(batch.colour, k, mix(at(batch.colour, k), woven, share) if share < f4(1) else woven)


@device("fast")
def light_cloth(
    n: int, batch: Batch, mesh: PosedMesh, screen: Screen, light: SceneLight, tables: Tables
) -> None:
    """Write the light of plain cloth at the first n patches, vertices, into `mesh.cloth_light`."""
    for k in range(n):
        corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
        if weigh(mesh.attributes, corners, weights, CURVATURE)[2] >= -screen.detail:
            woven = _cloth(mesh, screen, light, tables, corners, weights, COLLAR + SEAM)
            put(mesh.cloth_light, batch.column[k], woven)


@device("fast", inlined=True)
def covers(mesh: PosedMesh, corners: Corners) -> bool:
    """Return whether a triangle lies under plain cloth, away from the collar."""
    a, b, c = corners
    depth = min(mesh.attributes[a, EXTRA], mesh.attributes[b, EXTRA], mesh.attributes[c, EXTRA])
    return bool(depth > COLLAR + SEAM)


@device("fast")
def light_cloth_vertices(
    n: int,
    batch: Batch,
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    tables: Tables,
    linear: LinearTriangles,
) -> None:
    """Write the display light of the last n vertices of `batch.column`, and what stitches change of it."""
    albedo, whole = (tables.cloth[0], tables.cloth[1], tables.cloth[2]), (f4(1), f4(0), f4(0))
    count = len(linear.pores)
    for k in range(count - n, count):
        v = index(batch.column[k])
        view, normal = towards(screen.eye, at(mesh.positions, v)), unit(at(mesh.normals, v))
        free = mesh.attributes[v, OCCLUSION]
        woven = _lit(mesh, light, (v, v, v), whole, albedo, normal, view, mesh.shadow[v], free)
        linear.pores[v, 0] = THREAD * woven[1] * expose(v, woven, tables.film, linear)
        linear.pores[v, 1] = linear.pores[v, 2] = linear.pores[v, 3] = f4(0)


@device("fast")
def collar_shade(depth: float) -> float:
    """Return how much of its light plain cloth reflects at a place `depth` mm within the neckline."""
    seam = depth - COLLAR
    worn = f4(0.93) if seam < f4(0) else f4(1)
    return worn * (f4(1) - f4(0.35) * math.exp(-seam * seam * f4(0.6)))


@device("fast", inlined=True)
def _cloth(
    mesh: PosedMesh,
    screen: Screen,
    light: SceneLight,
    tables: Tables,
    corners: Corners,
    weights: Vec,
    depth: float,
) -> Vec:
    """Return the light from rough cloth with a soft sheen along its outline."""
    albedo = (tables.cloth[0], tables.cloth[1], tables.cloth[2])
    free = weigh(mesh.attributes, corners, weights, OCCLUSION)[0]
    rest = weigh(mesh.rest, corners, weights, 0)
    normal = unit(weigh(mesh.normals, corners, weights, 0))
    p = weigh(mesh.positions, corners, weights, 0)
    view, shadow = towards(screen.eye, p), shadow_at(mesh, light, corners, weights, p)
    albedo, normal = _knit(tables.grain, rest, albedo, normal, depth)
    return _lit(mesh, light, corners, weights, albedo, normal, view, shadow, free)


@device("fast", inlined=True)
def _lit(
    mesh: PosedMesh,
    light: SceneLight,
    corners: Corners,
    weights: Vec,
    albedo: Vec,
    normal: Vec,
    view: Vec,
    shadow: float,
    free: float,
) -> Vec:
    """Return the light from cloth of this albedo and normal."""
    total = times(albedo, ambient_light(light.ambient, normal, free))
    for k in range(len(light.lamps)):
        lit = cloth_share(dot(normal, lamp_direction(light.lamps, k)))
        total = along(
            total,
            times(albedo, lamp_colour(light.lamps, k)),
            lit * lamp_share(mesh.reach, corners, weights, k) * (shadow if k == 0 else f4(1)),
        )
    return along(total, ambient_light(light.ambient, normal, free), sheen(dot(normal, view)))


@device("fast")
def cloth_share(facing: float) -> float:
    """Return the share of a lamp's light that rough cloth scatters; `facing` is the cosine to the lamp."""
    return saturate((facing + f4(0.15)) * f4(1 / 1.15))


@device("fast")
def sheen(facing: float) -> float:
    """Return the share of the ambient light that fuzz scatters along an outline."""
    fuzz = f4(1) - saturate(facing)
    return f4(0.06) * fuzz * fuzz * fuzz


@device("fast")
def _knit(tile: Float32Array, rest: Vec, albedo: Vec, normal: Vec, depth: float) -> tuple[Vec, Vec]:
    """Return albedo and normal with stitches, and over the collar's width with ribs and a rolled edge."""
    thread = grain(tile, (rest[0], rest[1] * _LOW, rest[2]), _CELLS)[0]
    if depth < COLLAR:
        normal = rolled(normal, depth)
    return scale(albedo, knitted(thread, rest, depth)), normal


@device("fast")
def knitted(thread: float, rest: Vec, depth: float) -> float:
    """Return the share of its albedo that cloth has `depth` mm within the neckline at a height of thread."""
    light = f4(1) + THREAD * thread
    if depth < COLLAR:
        rib = math.sin(math.atan2(rest[0], rest[2] + f4(95)) * _RIBS)
        light *= f4(0.93) + f4(0.12) * rib
    seam = depth - COLLAR
    if abs(seam) < SEAM:
        light *= f4(1) - f4(0.35) * math.exp(-seam * seam * f4(0.6))
    return light


@device("fast")
def rolled(normal: Vec, depth: float) -> Vec:
    """Return the normal of the collar, whose edge is rolled."""
    edge = f4(1) - saturate(depth * f4(1 / 4.0))
    return unit(along(normal, UP, edge * edge))
