"""Plain matter for explaining pictures: clay, on which muscles and the mesh may be drawn."""

from __future__ import annotations

import math

from ..brdf import gloss
from ..inputs import (
    ALBEDO,
    EYE_LEFT,
    INNER,
    OCCLUSION,
    SKIN,
    TEETH,
    TONGUE,
    Batch,
    Light,
    Mesh,
    Paint,
    Pose,
    Sight,
    Tables,
)
from ..jit import device, f4, inlined
from ..lanes import LANES, POSITION, SHADOW, get
from ..lanes import put as put_lane
from ..vec import Vec, along, dot, mix, saturate, scale, smooth, sub, times, unit, unrotate, weigh
from .eye import IRIS, lid_distances, lid_shade
from .folds import bent, creased
from .lit import lamp_colour, lamp_direction, lamp_share, room_light
from .mouth import past_lips
from .painted import line_share, painted
from .patch import Corners, corners_of, put, towards, weights_of
from .shadows import find_shadows

_FACING = f4(0.04)
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
    count = 0
    for k in range(n):
        t = batch.triangle[k]
        if mesh.surfaces[t] <= TONGUE:
            place = weigh(mesh.positions, corners_of(mesh.triangles, t), weights_of(batch.weights, k), 0)
            batch.chosen[count] = k
            put_lane(batch.block, POSITION, count, place)
            count += 1
            if count == LANES:
                _shade_block(count, batch, mesh, sight, light, pose, tables, paint)
                count = 0
    if count:
        _shade_block(count, batch, mesh, sight, light, pose, tables, paint)


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
    find_shadows(count, batch.block, light)
    for lane in range(count):
        k, p, key = batch.chosen[lane], get(batch.block, POSITION, lane), batch.block[SHADOW + lane]
        t = batch.triangle[k]
        surface, corners, weights = (
            mesh.surfaces[t],
            corners_of(mesh.triangles, t),
            weights_of(batch.weights, k),
        )
        normal, view = unit(weigh(mesh.normals, corners, weights, 0)), towards(sight.eye, p)
        if surface == SKIN:
            colour = _skin(
                mesh, light, pose, tables, paint, t, corners, weights, p, normal, view, sight.pixel, key
            )
            line = line_share(mesh, paint, t, corners, weights, sight.samples)
            colour = mix(colour, (paint.ink[0], paint.ink[1], paint.ink[2]), line)
        elif surface >= TEETH:
            albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
            deep = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
            colour = _matt(mesh, light, corners, weights, normal, view, albedo, deep, deep, key)
        else:
            colour = _ball(mesh, light, pose, surface - EYE_LEFT, corners, weights, p, view, key)
        put(batch.colour, k, colour)


@inlined
def _skin(
    mesh: Mesh,
    light: Light,
    pose: Pose,
    tables: Tables,
    paint: Paint,
    t: int,
    corners: Corners,
    weights: Vec,
    p: Vec,
    normal: Vec,
    view: Vec,
    pixel: float,
    key: float,
) -> Vec:
    """Return the light from clay: matt, creased where the skin is, with what is painted on it."""
    albedo = weigh(mesh.attributes, corners, weights, ALBEDO)
    free = weigh(mesh.attributes, corners, weights, OCCLUSION)[0]
    inner = weigh(mesh.attributes, corners, weights, INNER)[0]
    if mesh.crease_regions[t]:
        rest = weigh(mesh.rest, corners, weights, 0)
        folds, deep = creased(tables, mesh, pose, t, corners, weights, rest, normal, dot(normal, view), pixel)
        normal = bent(normal, folds, _FLESH)
        free *= f4(1) - f4(0.7) * deep
    glow = (f4(0), f4(0), f4(0))
    if paint.covered[t]:
        albedo, glow = painted(paint, t, corners, weights, albedo, pixel)
    opened, passing = free, f4(1)
    if inner > f4(0.02):
        seen = past_lips(pose.rotation, pose.pivot, pose.lips, pose.lip_span, p)
        opened = free + (seen - free) * inner
        passing = f4(1) + (seen - f4(1)) * inner
    lit = _matt(mesh, light, corners, weights, normal, view, albedo, opened, passing, key)
    return along(lit, glow, opened)


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
    passing: float,
    key: float,
) -> Vec:
    """Return matt light with a broad, faint gloss of the key lamp."""
    shadow = key * passing
    total = times(albedo, room_light(light.room, normal, free))
    for k in range(len(light.lamps)):
        direction, colour = lamp_direction(light.lamps, k), lamp_colour(light.lamps, k)
        share = lamp_share(mesh.reach, corners, weights, k, shadow)
        facing = saturate((dot(normal, direction) + f4(0.12)) * f4(1 / 1.12))
        total = along(total, times(albedo, colour), facing * share * (passing if k else f4(1)))
    shine = gloss(normal, view, lamp_direction(light.lamps, 0), f4(0.34), _FACING) * shadow
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
    lit = _matt(mesh, light, corners, weights, outward, view, albedo, shade, shade, key)
    spark = gloss(outward, view, lamp_direction(light.lamps, 0), f4(0.03), _FACING) * shade
    return along(lit, lamp_colour(light.lamps, 0), min(spark, f4(1.2)))
