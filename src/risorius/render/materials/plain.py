"""Plain matter for explaining pictures: clay, on which muscles and the mesh may be drawn.

Skin is shaded in blocks (`lanes`), each step for all patches of a block.
"""

from __future__ import annotations

import math

from .. import inputs
from ..brdf import gloss
from ..inputs import EYE_LEFT, SKIN, TEETH, TONGUE, Batch, Light, Mesh, Paint, Pose, Sight, Tables
from ..jit import device, f4, i8, inlined
from ..lanes import (
    ALBEDO,
    FREE,
    INNER,
    LAMPS,
    LANES,
    NORMAL,
    OPENED,
    POSITION,
    REACH,
    SHADOW,
    SHINE,
    TOTAL,
    VIEW,
    face,
    get,
    put,
    read_reach,
)
from ..raster import FloatArray
from ..vec import Vec, add, along, dot, mix, saturate, scale, smooth, sub, times, unit, unrotate, weigh
from .eye import IRIS, lid_distances, lid_shade
from .folds import bent, creased
from .lit import glow, key_share, lamp_colour, lamp_direction, lamp_share, room_of
from .mouth import past_lips
from .painted import line_share, painted
from .patch import Corners, corners_of, towards, weights_of
from .patch import put as put_colour
from .shadows import shadow_at

_FACING = f4(0.04)
_ROUGH = f4(0.34)
_FLESH = f4(1.0)
_BALL = (f4(0.66), f4(0.66), f4(0.66))
_RING = (f4(0.16), f4(0.16), f4(0.17))
_PUPIL = f4(0.42)  # radii of the iris
_FAR = f4(20)  # mm: plain eyes have no corners


@device
def shade_plain(
    n: int,
    batch: Batch,
    mesh: Mesh,
    sight: Sight,
    light: Light,
    pose: Pose,
    tables: Tables,
    paint: Paint,
) -> None:
    """Colour the patches of skin, eyes, teeth and tongue among the first n of a row."""
    count = i8(0)
    for k in range(n):
        surface = mesh.surfaces[batch.triangle[k]]
        if surface == SKIN:
            _read(k, count, batch, mesh, light)
            count += 1
            if count == LANES:
                _shade_block(count, batch, mesh, sight, light, pose, tables, paint)
                count = i8(0)
        elif surface <= TONGUE:
            put_colour(batch.colour, k, _organ(k, surface, batch, mesh, sight, light, pose))
    if count:
        _shade_block(count, batch, mesh, sight, light, pose, tables, paint)


@inlined
def _read(k: int, lane: int, batch: Batch, mesh: Mesh, light: Light) -> None:
    """Read patch k of the mesh into a lane."""
    corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
    block = batch.block
    batch.chosen[lane] = k
    block[FREE + lane] = weigh(mesh.attributes, corners, weights, inputs.OCCLUSION)[0]
    block[INNER + lane] = weigh(mesh.attributes, corners, weights, inputs.INNER)[0]
    put(block, ALBEDO, lane, weigh(mesh.attributes, corners, weights, inputs.ALBEDO))
    p = weigh(mesh.positions, corners, weights, 0)
    put(block, POSITION, lane, p)
    block[SHADOW + lane] = shadow_at(mesh, light, corners, weights, p)
    put(block, NORMAL, lane, weigh(mesh.normals, corners, weights, 0))
    read_reach(block, lane, mesh.reach, corners, weights)


@device
def _shade_block(
    count: int,
    batch: Batch,
    mesh: Mesh,
    sight: Sight,
    light: Light,
    pose: Pose,
    tables: Tables,
    paint: Paint,
) -> None:
    """Light a block of clay: matt, creased where the skin is, with what is painted on it."""
    block = batch.block
    face(block, (sight.eye[0], sight.eye[1], sight.eye[2]))
    _fold(count, batch, mesh, pose, tables, sight.pixel)
    _shadow(count, block, pose)
    _paint(count, batch, mesh, paint, sight.pixel)
    _fill(block, light)
    for lamp in range(len(light.lamps)):
        _add_lamp(block, lamp, lamp_direction(light.lamps, lamp), lamp_colour(light.lamps, lamp))
    _add_gloss(block, lamp_direction(light.lamps, 0), lamp_colour(light.lamps, 0))
    ink = paint.ink[0], paint.ink[1], paint.ink[2]
    for lane in range(count):
        k, colour = batch.chosen[lane], get(block, TOTAL, lane)
        if paint.ink[3] > f4(0):
            corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
            line = line_share(mesh, paint, batch.triangle[k], corners, weights, sight.samples)
            colour = mix(colour, ink, line)
        put_colour(batch.colour, k, colour)


@device
def _fold(count: int, batch: Batch, mesh: Mesh, pose: Pose, tables: Tables, pixel: float) -> None:
    """Let wrinkles turn the normal and take the room's light away."""
    block = batch.block
    for lane in range(count):
        k = batch.chosen[lane]
        t = batch.triangle[k]
        if mesh.crease_raised[t]:
            corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
            normal, rest = get(block, NORMAL, lane), weigh(mesh.rest, corners, weights, 0)
            facing = dot(normal, get(block, VIEW, lane))
            slope, deep = creased(tables, mesh, pose, t, corners, weights, rest, normal, facing, pixel)
            put(block, NORMAL, lane, bent(normal, slope, _FLESH))
            block[FREE + lane] *= f4(1) - f4(0.7) * deep


@device
def _shadow(count: int, block: FloatArray, pose: Pose) -> None:
    """Find how much of the lamps and of the room's light arrives."""
    for lane in range(count):
        free, inner = block[FREE + lane], block[INNER + lane]
        if inner > f4(0.02):
            p = get(block, POSITION, lane)
            seen = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
            free += (seen - free) * inner
            for lamp in range(LAMPS):
                block[REACH + lamp * LANES + lane] *= f4(1) + (seen - f4(1)) * inner
        block[OPENED + lane] = free


@device
def _paint(count: int, batch: Batch, mesh: Mesh, paint: Paint, pixel: float) -> None:
    """Colour the clay with muscles; what is kept down of them glows."""
    block = batch.block
    for lane in range(LANES):
        put(block, SHINE, lane, (f4(0), f4(0), f4(0)))
    for lane in range(count):
        k = batch.chosen[lane]
        t = batch.triangle[k]
        if paint.covered[t]:
            corners, weights = corners_of(mesh.triangles, t), weights_of(batch.weights, k)
            albedo, light = painted(paint, t, corners, weights, get(block, ALBEDO, lane), pixel)
            put(block, ALBEDO, lane, albedo)
            put(block, SHINE, lane, scale(light, block[OPENED + lane]))


@device
def _fill(block: FloatArray, light: Light) -> None:
    """Begin with the room's light and what glows."""
    room = room_of(light.room)
    for k in range(LANES):
        arriving = glow(room, get(block, NORMAL, k), block[OPENED + k])
        put(block, TOTAL, k, add(get(block, SHINE, k), times(get(block, ALBEDO, k), arriving)))


@device
def _add_lamp(block: FloatArray, lamp: int, direction: Vec, colour: Vec) -> None:
    """Add the matt light of one lamp."""
    for k in range(LANES):
        share = block[REACH + lamp * LANES + k] * _facing(get(block, NORMAL, k), direction)
        share *= block[SHADOW + k] if lamp == 0 else f4(1)
        put(block, TOTAL, k, along(get(block, TOTAL, k), times(get(block, ALBEDO, k), colour), share))


@device
def _add_gloss(block: FloatArray, direction: Vec, colour: Vec) -> None:
    """Add a broad, faint gloss of the key lamp."""
    for k in range(LANES):
        shine = gloss(get(block, NORMAL, k), get(block, VIEW, k), direction, _ROUGH, _FACING)
        shine *= block[REACH + k] * block[SHADOW + k]
        put(block, TOTAL, k, along(get(block, TOTAL, k), colour, shine))


@device
def _facing(normal: Vec, direction: Vec) -> float:
    """Return the cosine of matt light, wrapped a little around the edge."""
    return saturate((dot(normal, direction) + f4(0.12)) * f4(1 / 1.12))


@inlined
def _organ(k: int, surface: int, batch: Batch, mesh: Mesh, sight: Sight, light: Light, pose: Pose) -> Vec:
    """Return the light from patch k of an eye, tooth or tongue."""
    corners, weights = corners_of(mesh.triangles, batch.triangle[k]), weights_of(batch.weights, k)
    p = weigh(mesh.positions, corners, weights, 0)
    key, view = key_share(light, p), towards(sight.eye, p)
    if surface < TEETH:
        return _ball(mesh, light, pose, surface - EYE_LEFT, corners, weights, p, view, key)
    albedo = weigh(mesh.attributes, corners, weights, inputs.ALBEDO)
    deep = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
    normal = unit(weigh(mesh.normals, corners, weights, 0))
    return _matt(mesh, light, corners, weights, normal, view, albedo, deep, key)


@inlined
def _matt(
    mesh: Mesh,
    light: Light,
    corners: Corners,
    weights: Vec,
    normal: Vec,
    view: Vec,
    albedo: Vec,
    free: float,
    key: float,
) -> Vec:
    """Return matt light with the gloss of clay, where the share `free` of all light arrives."""
    total = times(albedo, glow(room_of(light.room), normal, free))
    for k in range(len(light.lamps)):
        direction, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        share = lamp_share(mesh.reach, corners, weights, k) * free * (key if k == 0 else f4(1))
        total = along(total, times(albedo, colour), _facing(normal, direction) * share)
    shine = gloss(normal, view, lamp_direction(light.lamps, 0), _ROUGH, _FACING) * key * free
    return along(total, lamp_colour(light.lamps, 0), shine)


@inlined
def _ball(
    mesh: Mesh,
    light: Light,
    pose: Pose,
    side: int,
    corners: Corners,
    weights: Vec,
    p: Vec,
    view: Vec,
    key: float,
) -> Vec:
    """Return the light from an eye: a matt ball with a ring for the iris, in the shade of its lids."""
    centre = (pose.eyes[side, 0], pose.eyes[side, 1], pose.eyes[side, 2])
    outward = unit(sub(p, centre))
    local = unrotate(pose.eye_axes[side], outward)
    in_head = unrotate(pose.rotation, outward)
    below, above = lid_distances(pose.lids, pose.lid_span, side, in_head, pose.eye_radius[side])
    shade = lid_shade(below, above, _FAR, _FAR)
    ring = math.sqrt(local[0] * local[0] + local[1] * local[1]) / IRIS
    iris = f4(1) - smooth(f4(0.94), f4(1.06), ring)
    pupil = f4(1) - smooth(_PUPIL - f4(0.05), _PUPIL + f4(0.05), ring)
    albedo = mix(_BALL, _RING, iris if local[2] > f4(0) else f4(0))
    albedo = scale(albedo, f4(1) - f4(0.85) * pupil * iris)
    lit = _matt(mesh, light, corners, weights, outward, view, albedo, shade, key)
    spark = gloss(outward, view, lamp_direction(light.lamps, 0), f4(0.03), _FACING) * shade
    return along(lit, lamp_colour(light.lamps, 0), min(spark, f4(1.2)))
